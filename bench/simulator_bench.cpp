// SPDX-License-Identifier: Apache-2.0
// Cost of the simulator, in CPU time: steps, depth images, sight, the known map, a route.
#include <cstdio>

#include "core/simulator/route.hpp"
#include "core/simulator/simulate.hpp"
#include "services/common/time_now.hpp"

namespace {

using namespace foretrack;

template <class Work>
void measure(const char* what, int times, Work&& work) {
  const double before_s = cpu_s();
  for (int i = 0; i < times; ++i) work();
  std::printf("%-42s %9.3f ms\n", what, 1e3 * (cpu_s() - before_s) / times);
}

}  // namespace

int main() {
  Scenario scenario;
  scenario.generator = {WorldKind::kBoxes, 120, 510};
  SimulatorState state = make_simulator(scenario);
  measure("step of 10 ms, 120 boxes", 3000, [&] { simulate(state, {}, 0.01); });
  const auto& out = state.output;
  measure("depth image 160 x 120", 100,
          [&] { render(state.depth_camera, state.world, out.vehicle, out.target, 1.75); });
  double sum = 0.0;
  measure("sight of five body points", 3000,
          [&] { sum += sight_of(state.world, {}, out.vehicle, out.target, 1.75, 8.0).unhidden; });
  measure("known map 40 x 40 x 5 m at 0.15 m", 5,
          [&] { sum += static_cast<double>(known_map(state.world, 0.15).cell_count()); });
  measure("route of 100 m", 10, [&] {
    sum += static_cast<double>(generate_route(state.world, {.length_m = 100.0}).size());
  });
  return sum > 0.0 ? 0 : 1;
}
