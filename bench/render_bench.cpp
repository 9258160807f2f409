// SPDX-License-Identifier: Apache-2.0
// Cost of rendered camera images, and a look at them.
//   render_bench [--scenario NAME] [--seed N] [--person NAME] [--at S]... [--picture FILE]
#include <cstdio>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "bench/run_bench.hpp"
#include "core/simulator/color_camera.hpp"
#include "core/simulator/simulate.hpp"
#include "services/common/time_now.hpp"
#include "services/files/config/load_scenario.hpp"
#include "services/offline/people/load_person.hpp"

namespace {

using namespace foretrack;

struct Options {
  std::string scenario = "t_intersection", person = "boy", picture;
  std::uint64_t seed = 1;
  double at_s = 3.0, distance_m = 3.0, bearing_deg = 150.0, eye_m = 1.5;
};

// Looks at the person from beside their walk; 0° is in front of them.
VehicleState viewpoint(const PersonState& person, const Options& o) {
  const double bearing = person.body_yaw_rad + rad(o.bearing_deg);
  const Vec2 out = o.distance_m * direction_of(bearing);
  VehicleState vehicle;
  vehicle.position_enu_m = {person.position_enu_m.x() + out.x(),
                            person.position_enu_m.y() + out.y(), o.eye_m};
  vehicle.q_world_body = Quat(Eigen::AngleAxisd(bearing + kPi, Vec3::UnitZ()));
  return vehicle;
}

int run(const Options& o) {
  ScenarioOverrides overrides;
  overrides.seed = o.seed;
  Scenario scenario = load_scenario(o.scenario, overrides);
  scenario.generator.seed = o.seed;
  SimulatorState state = make_simulator(scenario);
  while (state.output.now_s < o.at_s) simulate(state, {}, 0.01);
  const double height_m = scenario.target.person.height_m;
  const double load_s = cpu_s();
  auto camera = make_color_camera({}, state.world, load_person(o.person));
  std::printf("scene and person loaded in %.0f ms\n", 1e3 * (cpu_s() - load_s));
  const VehicleState vehicle = viewpoint(state.person.state, o);
  double least_ms = 1e9;
  for (int i = 0; i < 30; ++i) {
    const double begin_s = cpu_s();
    render(camera, vehicle, state.person.state, height_m);
    least_ms = std::min(least_ms, 1e3 * (cpu_s() - begin_s));
  }
  std::printf("image of 640 x 480 with depth: %.1f ms, %zu facets drawn\n", least_ms,
              camera.canvas.facets.size());
  if (o.picture.empty()) return 0;
  const cv::Mat rgb(480, 640, CV_8UC3, camera.image.pixels.rgb.data());
  cv::Mat bgr;
  cv::cvtColor(rgb, bgr, cv::COLOR_RGB2BGR);
  return cv::imwrite(o.picture, bgr) ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  Options o;
  CLI::App app("cost of rendered camera images");
  app.add_option("--scenario", o.scenario)->capture_default_str();
  app.add_option("--seed", o.seed)->capture_default_str();
  app.add_option("--person", o.person)->capture_default_str();
  app.add_option("--at", o.at_s, "seconds into the walk")->capture_default_str();
  app.add_option("--distance", o.distance_m, "m")->capture_default_str();
  app.add_option("--bearing", o.bearing_deg, "degrees; 0: in front of the person")
      ->capture_default_str();
  app.add_option("--eye", o.eye_m, "height of the camera, m")->capture_default_str();
  app.add_option("--picture", o.picture, "PNG or JPEG to write");
  return run_bench(app, argc, argv, [&] { return run(o); });
}
