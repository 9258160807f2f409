// SPDX-License-Identifier: Apache-2.0
// The picture for the ground on a rendered flight, as JPEG and as H.264, at several bandwidths: the
// processor's time for each, how large it is, how many a second, and how near to the image.
#include <fmt/format.h>

#include <functional>

#include "bench/dds/recorded_world.hpp"
#include "bench/dds/stage_delay.hpp"
#include "bench/run_bench.hpp"
#include "core/perception/shrink_image.hpp"
#include "core/perception/stream_pace.hpp"
#include "services/common/time_now.hpp"
#include "services/convert/compressed_image.hpp"
#include "services/convert/encode_h264.hpp"
#include "services/convert/encode_jpeg.hpp"
#include "services/files/config/load_scenario.hpp"
#include "tests/support/h264_decoder.hpp"

namespace foretrack {
namespace {

using Bytes = std::vector<std::uint8_t>;

struct Options {
  std::string scenario = "street_blocks";
  double seconds = 20.0;
  int width_px = 640;
  std::vector<double> kbit_s = {2000.0, 1000.0, 500.0};
};

/// One way to make and to look at a picture.
struct Way {
  const char* name;
  std::function<void(const RgbImage&, const StreamPace&, const StreamParams&, double, Bytes&)> make;
  std::function<std::optional<RgbImage>(const Bytes&, const RgbImage&)> look;
};

Way jpeg() {
  const auto make = [](const RgbImage& image, const StreamPace& pace, const StreamParams& params,
                       double, Bytes& out) { encode_jpeg(image, quality_of(pace, params), out); };
  const auto look = [](const Bytes& bytes, const RgbImage& like) -> std::optional<RgbImage> {
    sensor_msgs::msg::CompressedImage message;
    message.data(bytes);
    CameraModel camera;
    camera.width_px = like.width_px;
    camera.height_px = like.height_px;
    auto image = rgb_from_idl(message, camera);
    return image ? std::optional(*image) : std::nullopt;
  };
  return {"JPEG", make, look};
}

Way h264() {
  auto encoder = std::make_shared<H264Encoder>();
  const auto make = [encoder](const RgbImage& image, const StreamPace&, const StreamParams& params,
                              double stamp_s, Bytes& out) {
    encoder->encode(image, {stamp_s, params.bandwidth_kbit_s, params.rate_hz, 1}, out);
  };
#if __has_include(<wels/codec_api.h>)
  auto decoder = std::make_shared<testing::H264Decoder>();
  return {"H.264", make, [decoder](const Bytes& b, const RgbImage&) { return decoder->decode(b); }};
#else
  return {"H.264", make, [](const Bytes&, const RgbImage&) { return std::nullopt; }};
#endif
}

void measure(const Way& way, double kbit_s, const Options& o,
             const std::vector<RecordedStep>& steps) {
  const StreamParams params{.bandwidth_kbit_s = kbit_s, .width_px = o.width_px};
  StreamPace pace;
  RgbImage small;
  Bytes picture;
  std::vector<double> cost_ms, kilobytes, psnr;
  for (const RecordedStep& step : steps) {
    if (!step.color || !is_due(pace, step.color->stamp_s, params)) continue;
    shrink(step.color->pixels, params.width_px, small);
    const double begin_ms = cpu_ms();
    way.make(small, pace, params, step.color->stamp_s, picture);
    cost_ms.push_back(cpu_ms() - begin_ms);
    sent(pace, step.color->stamp_s, static_cast<double>(picture.size()), params);
    kilobytes.push_back(1e-3 * static_cast<double>(picture.size()));
    if (const auto seen = way.look(picture, small)) psnr.push_back(testing::psnr_db(small, *seen));
  }
  double sum_kb = 0.0;
  for (const double kb : kilobytes) sum_kb += kb;
  fmt::print("{:<6} {:6.0f} {:7.0f} {:6.1f} {:7.2f} {:7.2f} {:6.1f} {:6.1f} {:7.1f} {:6.1f}\n",
             way.name, kbit_s, 8.0 * sum_kb / o.seconds,
             static_cast<double>(cost_ms.size()) / o.seconds, quantile_of(cost_ms, 0.5),
             quantile_of(cost_ms, 0.99), quantile_of(kilobytes, 0.5), quantile_of(kilobytes, 1.0),
             quantile_of(psnr, 0.5), quantile_of(psnr, 0.05));
}

int run(const Options& o) {
  ScenarioOverrides overrides;
  overrides.duration_s = o.seconds;
  overrides.color_images = true;
  const auto steps = record_world(load_scenario(o.scenario, overrides));
  fmt::print("{:<6} {:>6} {:>7} {:>6} {:>7} {:>7} {:>6} {:>6} {:>7} {:>6}\n", "", "kbit/s", "came",
             "1/s", "ms p50", "p99", "kB p50", "most", "dB p50", "p5");
  for (const double kbit_s : o.kbit_s) {
    measure(jpeg(), kbit_s, o, steps);
    if (has_video_encoder()) measure(h264(), kbit_s, o, steps);
  }
  return 0;
}

}  // namespace
}  // namespace foretrack

int main(int argc, char** argv) {
  foretrack::Options o;
  CLI::App app("the picture for the ground, as JPEG and as H.264, of a rendered flight");
  app.add_option("--scenario", o.scenario)->capture_default_str();
  app.add_option("--seconds", o.seconds, "of the flight")->capture_default_str();
  app.add_option("--width", o.width_px, "px")->capture_default_str();
  app.add_option("--bandwidths", o.kbit_s, "kbit/s");
  return foretrack::run_bench(app, argc, argv, [&] { return foretrack::run(o); });
}
