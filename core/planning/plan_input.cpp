// SPDX-License-Identifier: Apache-2.0
#include "core/planning/plan_input.hpp"

namespace foretrack {
namespace {

bool is_usable(const GridMap& map, double now_s, double stale_s) {
  return !map.empty() && (map.stamp_s == 0.0 || now_s - map.stamp_s < stale_s);
}

}  // namespace

PlanInput without_stale(PlanInput in, const HorizonParams& params) {
  const auto is_stale = [&](const auto* message) {
    return message != nullptr && in.now_s - message->stamp_s >= params.target_stale_s;
  };
  if (in.target.usable() && is_stale(&in.target)) in.target.status = TrackStatus::kLost;
  if (is_stale(in.intention)) in.intention = nullptr;
  if (is_stale(in.prediction)) in.prediction = nullptr;
  if (is_stale(in.bodies)) in.bodies = nullptr;
  if (in.map != nullptr && !is_usable(*in.map, in.now_s, params.map_stale_s)) in.map = nullptr;
  return in;
}

}  // namespace foretrack
