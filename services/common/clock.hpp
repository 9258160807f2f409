// SPDX-License-Identifier: Apache-2.0
// What time it is: the system's, or the simulator's.
#pragma once

#include <functional>

#include "builtin_interfaces/msg/Time.h"

namespace foretrack {

class Node;
class ReaderCore;

double to_seconds(const builtin_interfaces::msg::Time& time);
/// Throws std::invalid_argument if the time does not fit (negative, NaN, after 2106).
builtin_interfaces::msg::Time to_stamp(double seconds);

class Clock {
 public:
  /// Simulated: from rosgraph_msgs/Clock; 0 until the first sample.
  Clock(Node& node, bool simulated);

  bool simulated() const { return simulated_; }
  /// Seconds since 1970, or simulated.
  double now_s() const;
  builtin_interfaces::msg::Time now() const { return to_stamp(now_s()); }
  /// For periods: does not jump when the system's clock is set.
  double steady_s() const;
  /// Why a stamp cannot be right: malformed, or more than half a second ahead; null: it can.
  const char* fault_of(const builtin_interfaces::msg::Time& stamp) const;
  /// Takes the newest clock sample. The loop calls it.
  void update();
  /// That the loop wakes on; null by the system's clock.
  ReaderCore* reader() { return reader_; }

 private:
  bool simulated_;
  double simulated_s_ = 0.0;
  std::function<void()> take_;
  ReaderCore* reader_ = nullptr;
};

}  // namespace foretrack
