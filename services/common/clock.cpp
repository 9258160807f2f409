// SPDX-License-Identifier: Apache-2.0
#include "services/common/clock.hpp"

#include <cmath>
#include <memory>
#include <stdexcept>

#include "rosgraph_msgs/msg/Clock.h"
#include "services/common/reader.hpp"
#include "services/common/time_now.hpp"
#include "services/common/topics.hpp"

namespace foretrack {
namespace {

constexpr double kFutureSlack_s = 0.5;

bool is_well_formed(const builtin_interfaces::msg::Time& time) {
  return time.sec() >= 0 && time.nanosec() < 1000000000u;
}

}  // namespace

double to_seconds(const builtin_interfaces::msg::Time& time) {
  return time.sec() + 1e-9 * time.nanosec();
}

builtin_interfaces::msg::Time to_stamp(double seconds) {
  if (!(seconds >= 0.0 && seconds < 2147483647.0))
    throw std::invalid_argument("time " + std::to_string(seconds) + " s: 0 to 2^31 - 1 expected");
  const double whole = std::floor(seconds);
  const double nanoseconds = std::round((seconds - whole) * 1e9);
  builtin_interfaces::msg::Time stamp;
  const bool carry = nanoseconds >= 1e9;
  stamp.sec(static_cast<std::int32_t>(whole) + (carry ? 1 : 0));
  stamp.nanosec(carry ? 0 : static_cast<std::uint32_t>(nanoseconds));
  return stamp;
}

Clock::Clock(Node& node, bool simulated) : simulated_(simulated) {
  if (!simulated) return;
  auto reader = std::make_shared<Reader<topics::Clock>>(node, [](const auto& sample) {
    return is_well_formed(sample.clock()) ? nullptr : "malformed clock";
  });
  reader_ = &reader->core();
  take_ = [this, reader] {
    if (const auto* sample = reader->take_newest()) simulated_s_ = to_seconds(sample->clock());
  };
}

double Clock::now_s() const {
  return simulated_ ? simulated_s_ : 1e-9 * static_cast<double>(now_ns());
}

double Clock::steady_s() const {
  return simulated_ ? simulated_s_ : foretrack::steady_s();
}

const char* Clock::fault_of(const builtin_interfaces::msg::Time& stamp) const {
  if (!is_well_formed(stamp)) return "malformed stamp";
  const double now = now_s();
  const bool known = now > 0.0;  // simulated time begins with the first clock sample
  return known && to_seconds(stamp) > now + kFutureSlack_s ? "stamp in the future" : nullptr;
}

void Clock::update() {
  if (take_) take_();
}

}  // namespace foretrack
