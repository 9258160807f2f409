// SPDX-License-Identifier: Apache-2.0
// The operator of a lock-step flight.
#pragma once

#include <optional>
#include <vector>

#include "core/safety/mission.hpp"
#include "core/simulator/scenario.hpp"

namespace foretrack {

/// Starts the flight, and orders what the scenario says, each under a lease that is taken for it.
class SteadyOperator {
 public:
  explicit SteadyOperator(const Scenario& scenario) : orders_(scenario.orders) {}

  /// Null: nothing is ordered now. Valid until the next call.
  const MissionCommand* order(double now_s);

 private:
  void take(const OperatorOrder& order);

  std::vector<OperatorOrder> orders_;
  std::size_t next_ = 0;
  bool has_lease_ = false;
  MissionCommand command_;
};

}  // namespace foretrack
