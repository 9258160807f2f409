// SPDX-License-Identifier: Apache-2.0
#include "services/offline/flight/steady_operator.hpp"

#include <utility>

namespace foretrack {

const MissionCommand* SteadyOperator::order(double now_s) {
  command_ = {.id = command_.id + 1, .stamp_s = now_s, .lease_id = "lease", .proved = true};
  if (command_.id == 1) return &command_;  // start
  if (next_ == orders_.size() || now_s < orders_[next_].at_s) return nullptr;
  command_.order = MissionOrder::kLease;
  if (std::exchange(has_lease_, !has_lease_)) take(orders_[next_++]);
  return &command_;
}

void SteadyOperator::take(const OperatorOrder& order) {
  command_.order = order.follow ? MissionOrder::kFollow : MissionOrder::kSetFraming;
  command_.person_id = order.follow.value_or(0);
  command_.framing = order.framing;
}

}  // namespace foretrack
