// SPDX-License-Identifier: Apache-2.0
// When what befalls the vehicles of a fleet.
#pragma once

#include <algorithm>
#include <optional>
#include <span>

#include "core/simulator/scenario.hpp"

namespace foretrack {

/// Of one kind, in the scenario's time. Never: after all times; who need not join is there from
/// before the begin.
inline double failure_s(const Scenario& scenario, std::string_view vehicle, FleetFailureKind kind) {
  for (const FleetFailure& failure : scenario.failures)
    if (failure.vehicle == vehicle && failure.kind == kind) return failure.at_s;
  return kind == FleetFailureKind::kJoins ? -1.0 : 1e18;
}

/// Whether a vehicle is there. Who joins does so at its time, or as soon as there is room at its
/// place then: nobody takes off amid others, or beside the person.
class Presence {
 public:
  /// Once a step. `others`: the vehicles that are there.
  void update(const Scenario& scenario, std::string_view vehicle, double time_s,
              const Vec3& place_enu_m, const Vec3& person_enu_m, std::span<const Vec3> others) {
    const bool due = time_s >= failure_s(scenario, vehicle, FleetFailureKind::kJoins);
    const auto is_near = [&](const Vec3& other) {
      return distance_xy(other, place_enu_m) < kRoom_m;
    };
    const bool room = !is_near(person_enu_m) && std::ranges::none_of(others, is_near);
    if (!joined_s_ && due && (time_s <= 0.0 || room)) joined_s_ = time_s;
    died_ = time_s >= failure_s(scenario, vehicle, FleetFailureKind::kDies);
  }
  bool is_there() const { return joined_s_.has_value() && !died_; }
  /// None: it has not joined yet.
  std::optional<double> joined_s() const { return joined_s_; }

 private:
  static constexpr double kRoom_m = 3.0;

  std::optional<double> joined_s_;
  bool died_ = false;
};

}  // namespace foretrack
