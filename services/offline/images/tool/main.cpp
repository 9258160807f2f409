// SPDX-License-Identifier: Apache-2.0
// foretrack perceive: people in pictures, videos and cameras, without DDS. A program of its own, so
// that no service of the vehicle loads OpenCV's codecs.
#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <csignal>
#include <cstdio>
#include <memory>

#include "services/common/time_now.hpp"
#include "services/files/models/pose_models.hpp"
#include "services/offline/images/frame_sink.hpp"
#include "services/offline/images/person_finder.hpp"

namespace foretrack {
namespace {

constexpr double kProgress_s = 0.5;

volatile std::sig_atomic_t stopped = 0;
void on_signal(int) {
  stopped = 1;
}

struct PerceiveOptions {
  std::vector<std::string> images;
  std::string video, camera, calibration, out, model;
  std::vector<std::pair<std::string, std::string>> settings;
  double height_m = 0.0;
  double for_s = 0.0;
  bool json = false;
  bool still() const { return !images.empty(); }
};

std::unique_ptr<FrameSource> open_source(const PerceiveOptions& o) {
  const int sources = !o.images.empty() + !o.video.empty() + !o.camera.empty();
  if (sources != 1) throw std::invalid_argument("one of --image, --video and --camera is expected");
  if (o.still() && !o.out.empty() && (o.images.size() != 1 || is_video_name(o.out)))
    throw std::invalid_argument("--out with --image: one picture in, one picture (.png, .jpg) out");
  if (!o.still() && !o.out.empty() && !is_video_name(o.out))
    throw std::invalid_argument("--out " + o.out + ": a video (.mp4, .avi, .mkv) is expected");
  if (o.still()) return open_pictures(o.images);
  return o.camera.empty() ? open_video(o.video) : open_camera(o.camera);
}

PerceptionParams params_of(const PerceiveOptions& o) {
  PerceptionParams params;
  const ParamRows rows_of_params = rows(params);
  for (const auto& [name, value] : o.settings) {
    const std::string fault = set_param(rows_of_params, name, value);
    if (!fault.empty()) throw std::invalid_argument("--set: " + fault);
  }
  if (o.height_m > 0.0) params.target_height_m = o.height_m;
  if (o.model == "lite") params.model_complexity = 0;
  if (o.model == "full") params.model_complexity = 1;
  if (o.model == "heavy") params.model_complexity = 2;
  return params;
}

std::string line_of(const SeenPerson& person) {
  const std::string score = fmt::format("{:.0f} %", 100.0 * person.pose.score);
  if (!person.place) return score;
  const Vec3& p = person.place->torso_camera_m;
  return fmt::format("{}  x {:.2f}  y {:.2f}  z {:.2f} m  yaw {:.0f} deg", score, p.x(), p.y(),
                     p.z(), deg(person.place->yaw_rad));
}

// Counts, shows progress, prints what was asked for.
class Report {
 public:
  Report(const PerceiveOptions& o, int count) : options_(o), count_(count) {}

  void add(const SeenFrame& frame, double spent_s) {
    ++frames_;
    spent_s_ += spent_s;
    seen_ += !frame.people.empty();
    if (options_.json) {
      fmt::print("{}{}", frames_ == 1 ? "{\"frames\": [\n" : ",\n", json_of(frame).dump());
    } else if (options_.still()) {
      fmt::print("{}: {} {}\n", frame.file, frame.people.size(),
                 frame.people.size() == 1 ? "person" : "people");
      for (const auto& person : frame.people) fmt::print("  {}\n", line_of(person));
    } else {
      for (const auto& person : frame.people)
        fmt::print("{:8.3f} s  {}\n", frame.stamp_s, line_of(person));
    }
    progress();
  }
  void finish(bool ambiguous) {
    if (options_.json) fmt::print("{}\n]}}\n", frames_ == 0 ? "{\"frames\": [" : "");
    if (ambiguous) fmt::print(stderr, "Several people were in view: one was chosen.\n");
    fmt::print(stderr, "{} frames, a person in {}; {:.1f} ms a frame: {:.0f} frames a second\n",
               frames_, seen_, frames_ ? 1e3 * spent_s_ / frames_ : 0.0,
               spent_s_ > 0.0 ? frames_ / spent_s_ : 0.0);
  }

 private:
  void progress() {
    if (!isatty(STDERR_FILENO) || steady_s() - shown_s_ < kProgress_s) return;
    shown_s_ = steady_s();
    fmt::print(stderr, "\rframe {}{}, {:.0f} frames a second \r", frames_,
               count_ > 0 ? fmt::format(" of {}", count_) : "", frames_ / spent_s_);
    std::fflush(stderr);
  }

  const PerceiveOptions& options_;
  int count_, frames_ = 0, seen_ = 0;
  double spent_s_ = 0.0;  // on looking; not on reading and writing
  double shown_s_ = steady_s();
};

int perceive_with(const PerceiveOptions& o) {
  const PerceptionParams params = params_of(o);
  std::optional<CameraWithLens> calibration;
  if (!o.calibration.empty()) {
    calibration = load_calibration(o.calibration);
    fmt::print(stderr, "{}: {}\n", o.calibration, describe(*calibration));
  }
  const auto source = open_source(o);
  const auto sink = o.out.empty() ? nullptr : open_sink(o.out, source->rate_hz());
  PersonFinder finder(load_shipped_pose_network(params.model_complexity), params, calibration);
  if (!calibration)
    fmt::print(stderr, "No --calibration: landmarks only, without position and yaw.\n");
  std::signal(SIGINT, on_signal);
  std::signal(SIGTERM, on_signal);
  Report report(o, source->count());
  while (!stopped) {
    auto frame = source->next();
    if (!frame || (o.for_s > 0.0 && frame->stamp_s > o.for_s)) break;
    const double start_s = steady_s();
    const SeenFrame seen = o.still() ? finder.look(*frame) : finder.follow(*frame);
    report.add(seen, steady_s() - start_s);
    if (!sink) continue;
    for (const auto& person : seen.people) draw_person(frame->image, person.pose, line_of(person));
    sink->write(frame->image);
  }
  report.finish(finder.ambiguous());
  return 0;
}

void add_options(CLI::App& app, PerceiveOptions& o) {
  app.add_option("--image", o.images, "pictures; everybody in them is found");
  app.add_option("--video", o.video, "a video; one person is followed");
  app.add_option("--camera", o.camera, "a device, e.g. /dev/video0, until Ctrl-C");
  app.add_option("--calibration", o.calibration,
                 "of the camera, as ROS camera_calibration writes it; without it no positions");
  app.add_option("--height", o.height_m, "of the person in metres")->check(CLI::Range(0.5, 2.5));
  app.add_option("--model", o.model, "size of the network")
      ->check(CLI::IsMember({"lite", "full", "heavy"}));
  app.add_option("--set", o.settings, "a parameter of perception and its value");
  app.add_option("--for", o.for_s, "seconds of the video or camera")->check(CLI::PositiveNumber);
  app.add_option("--out", o.out, "annotated picture or video");
  app.add_flag("--json", o.json, "print the frames as JSON");
}

}  // namespace
}  // namespace foretrack

int main(int argc, char** argv) {
  CLI::App app("foretrack perceive: people in pictures, videos and cameras", "foretrack perceive");
  foretrack::PerceiveOptions options;
  foretrack::add_options(app, options);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  try {
    return foretrack::perceive_with(options);
  } catch (const std::invalid_argument& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 2;
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 1;
  }
}
