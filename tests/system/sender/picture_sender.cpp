// SPDX-License-Identifier: Apache-2.0
// A vehicle's pictures for the ground and nothing else: a camera of 30 images a second that sees a
// street pass by, and the ground stream of perception. Runs until it is killed.
#include <CLI/CLI.hpp>

#include "services/convert/camera_info.hpp"
#include "services/onboard/perception/ground_stream.hpp"
#include "tests/support/street.hpp"

int main(int argc, char** argv) {
  using namespace foretrack;
  ServiceOptions options;
  CLI::App app("pictures for the ground, of a street that passes by");
  add_options(app, options);
  CLI11_PARSE(app, argc, argv);
  Stop stop;
  Service service("perception", options, stop);
  const StreamParams params;
  GroundStream stream(service, params);
  constexpr int kTurn = 20;  // images until it passes by backwards
  std::vector<RgbImage> images;
  for (int i = 0; i <= kTurn; ++i) images.push_back(testing::street(4.0 * i, 640, 480));
  sensor_msgs::msg::CameraInfo info;
  to_idl(CameraModel::from_fov(640, 480, 1.5, 1.2), 0.0, info);
  int next = 0;
  service.loop().every_wall(1.0 / 30.0, [&] {
    const int i = next++ % (2 * kTurn);
    stream.offer(images[i < kTurn ? i : 2 * kTurn - i], info, service.clock().now_s(), "camera");
  });
  service.run();
}
