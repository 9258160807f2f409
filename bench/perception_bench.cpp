// SPDX-License-Identifier: Apache-2.0
// Accuracy of the estimate of a walking person, and the cost of one observation in CPU time.
#include <cstdio>

#include "services/common/time_now.hpp"
#include "tests/core/perception/tracking_error.hpp"

namespace {

using namespace foretrack;

void print_accuracy(double speed_m_s, double range_m, double noise) {
  test::FollowScene scene;
  scene.walk.speed_m_s = speed_m_s;
  scene.range_m = range_m;
  scene.noise = {2.0 * noise, 0.03 * noise};
  const auto e = test::follow(40, scene);
  std::printf("%4.1f %5.1f %5.1f | %5.3f %5.3f | %5.2f %5.2f %5.2f | %4.1f %4.1f %5.2f | %4.1f\n",
              speed_m_s, range_m, noise, e.position_m, e.position_straight_m, e.velocity_m_s,
              e.velocity_straight_m_s, e.velocity_lag_s, deg(e.yaw_rad), deg(e.yaw_straight_rad),
              e.yaw_lag_s, e.straight_nees);
}

double cost_us() {
  test::PersonState person;
  person.hips_enu_m = {2.0, 0.0, 0.95};
  const auto vehicle = test::vehicle_at(0.0, {0.0, 0.0, 1.4}, person.hips_enu_m);
  VehicleHistory history;
  history.add(vehicle);
  Random random(1);
  auto observation = test::observe(person, vehicle, {}, random);
  PerceptionState state;
  const PerceptionParams params;
  const int calls = 2000;
  const double before_s = cpu_s();
  for (int k = 0; k < calls; ++k) {
    observation.stamp_s = 1e-5 * (k + 1);
    perceive(state, observation, history, params);
  }
  return 1e6 * (cpu_s() - before_s) / calls;
}

}  // namespace

int main() {
  std::puts("speed range noise | position  m | velocity    m/s  lag | yaw   deg    lag | NEES");
  std::puts("  m/s     m     × |   all  strt |   all  strt      s |  all strt      s | of 4");
  for (const double speed_m_s : {1.0, 1.5, 2.0}) print_accuracy(speed_m_s, 2.0, 1.0);
  for (const double range_m : {3.0, 4.0, 6.0}) print_accuracy(1.5, range_m, 1.0);
  for (const double noise : {0.5, 2.0, 3.0}) print_accuracy(1.5, 2.0, noise);
  std::printf("perceive: %.1f us\n", cost_us());
}
