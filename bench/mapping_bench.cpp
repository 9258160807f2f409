// SPDX-License-Identifier: Apache-2.0
// Cost of one update of the map, in CPU time: a vehicle flies through rooms at 2 m/s.
#include <octomap/OcTree.h>

#include <algorithm>
#include <cstdio>

#include "core/mapping/update_map.hpp"
#include "services/common/time_now.hpp"
#include "tests/core/mapping/box_world.hpp"

namespace {

using namespace foretrack;

test::World rooms() {
  test::World world = {{{-20, -20, -0.3}, {60, 20, 0}}, {{-20, -20, 2.8}, {60, 20, 3}}};
  for (int k = 0; k < 10; ++k) {
    const double x = 4.0 * k, side = k % 2 ? 1.0 : -1.0;
    world.push_back(
        {{x, std::min(side * 1.2, side * 9), 0}, {x + 0.2, std::max(side * 1.2, side * 9), 2.8}});
    world.push_back({{x + 2, side * 0.5 - 0.2, 0}, {x + 2.3, side * 0.5 + 0.1, 2.8}});
  }
  return world;
}

void measure(int width_px, int height_px) {
  const auto camera = CameraModel::from_fov(width_px, height_px, rad(90.0), rad(75.0));
  const test::World world = rooms();
  MappingParams params;
  MappingState state(params);
  VehicleHistory history;
  std::vector<double> ms;
  for (int k = 0; k < 200; ++k) {
    const double t = k / 15.0;
    const auto vehicle = test::vehicle_at(t, {2.0 * t, 0.0, 1.4}, 0.5 * std::sin(t));
    history.add(vehicle);
    const DepthImage image = test::render(world, vehicle, camera);
    const double before_s = cpu_s();
    update_map(state, image, history, {}, params);
    ms.push_back(1e3 * (cpu_s() - before_s));
  }
  std::sort(ms.begin(), ms.end());
  std::printf("%4d x %d: P50 %.2f  P95 %.2f  max %.2f ms; octree %.1f MB\n", width_px, height_px,
              ms[100], ms[190], ms.back(), 1e-6 * static_cast<double>(state.tree->memoryUsage()));
}

}  // namespace

int main() {
  measure(640, 480);
  measure(320, 240);
  measure(160, 120);
}
