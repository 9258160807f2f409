// SPDX-License-Identifier: Apache-2.0
#include "services/convert/prediction.hpp"

#include <stdexcept>

#include "core/prediction/assess_intention.hpp"
#include "services/convert/geometry.hpp"

namespace foretrack {
namespace {

namespace msg = foretrack_msgs::msg;
namespace statuses = msg::TargetPrediction_Constants;
static_assert(statuses::STATUS_OK == int(PredictionStatus::kOk));
static_assert(statuses::STATUS_NO_TARGET == int(PredictionStatus::kNoTarget));
static_assert(statuses::STATUS_TARGET_BLOCKED == int(PredictionStatus::kTargetBlocked));
static_assert(statuses::STATUS_SEARCH_EXHAUSTED == int(PredictionStatus::kSearchExhausted));

constexpr double kScore = 1e6;  // potentials and observations are not bounded above
constexpr std::size_t kMaxPaths = 16;
constexpr std::size_t kMaxStates = 64;

void to_idl(const ReachableRegion& in, msg::ReachableRegion& out) {
  out.center_m(to_array(in.center_enu_m));
  out.radius_m(in.radius_m);
  out.heading_rad(in.heading_rad);
  out.left_half_angle_rad(in.left_half_angle_rad);
  out.right_half_angle_rad(in.right_half_angle_rad);
  out.left_bisector_yaw_rad(in.left_bisector_rad());
  out.right_bisector_yaw_rad(in.right_bisector_rad());
}

ReachableRegion read_region(Checks& checks, const msg::ReachableRegion& in) {
  checks.within("region.center_m", in.center_m(), limits::kPosition_m);
  checks.in_range("region.radius_m", in.radius_m(), 0.0, limits::kPosition_m);
  checks.within("region.heading_rad", in.heading_rad(), limits::kAngle_rad);
  checks.in_range("region.left_half_angle_rad", in.left_half_angle_rad(), 0.0, kPi);
  checks.in_range("region.right_half_angle_rad", in.right_half_angle_rad(), 0.0, kPi);
  return {.center_enu_m = to_vec3(in.center_m()),
          .radius_m = in.radius_m(),
          .heading_rad = in.heading_rad(),
          .left_half_angle_rad = in.left_half_angle_rad(),
          .right_half_angle_rad = in.right_half_angle_rad()};
}

IntentionBelief read_belief(Checks& checks, const msg::IntentionScore& in) {
  checks.within("intentions.potential", in.potential(), kScore);
  checks.within("intentions.observation", in.observation(), kScore);
  checks.in_range("intentions.score", in.score(), 0.0, 1.0);
  checks.in_range("intentions.probability", in.probability(), 0.0, 1.0);
  return {in.potential(), in.observation(), in.score(), in.probability()};
}

PredictedState read_state(Checks& checks, const msg::PredictedState& in, double previous_s) {
  const double t = in.time_from_stamp_s();
  if (!(t > previous_s && t <= limits::kDuration_s))
    checks.fail("paths.states.time_from_stamp_s", std::to_string(t), "growing from above 0");
  checks.within("paths.states.position_m", in.position_m(), limits::kPosition_m);
  checks.within("paths.states.velocity_mps", in.velocity_mps(), limits::kSpeed_m_s);
  checks.covariance("paths.states.covariance_xy_m2", in.covariance_xy_m2().data(), 2);
  return {t, to_vec3(in.position_m()), to_vec3(in.velocity_mps()),
          from_rows<2>(in.covariance_xy_m2())};
}

PredictedPath read_path(Checks& checks, const msg::PredictedPath& in) {
  PredictedPath out;
  checks.in_range("paths.probability", in.probability(), 0.0, 1.0);
  checks.count("paths.states", in.states().size(), 1, kMaxStates);
  if (!checks.ok()) return out;
  // Where somebody may walk is worth knowing whatever it is called.
  out.intention = intention_named(std::string_view(in.name().c_str())).value_or(kUnknownIntention);
  out.probability = in.probability();
  out.states.reserve(in.states().size());
  double previous_s = 0.0;
  for (const auto& state : in.states()) {
    out.states.push_back(read_state(checks, state, previous_s));
    previous_s = state.time_from_stamp_s();
  }
  return out;
}

}  // namespace

void to_idl(const IntentionAssessment& in, msg::TargetIntention& out) {
  set_header(out.header(), in.stamp_s);
  out.intentions().resize(kIntentions.size());
  for (const IntentionRow& intention : kIntentions) {
    const IntentionBelief& belief = in[intention.id];
    auto& row = out.intentions()[index_of(intention.id)];
    row.name(std::string(intention.name));
    row.color_rgb(intention.color_rgb);
    row.potential(belief.potential);
    row.observation(belief.observation);
    row.score(belief.score);
    row.probability(belief.probability);
  }
  to_idl(in.region, out.region_now());
  to_idl(in.region_ahead, out.region_ahead());
  out.obstacle_distance_m(in.obstacle_distance_m);
  out.body_turn_angle_rad(in.body_turn_rad);
}

Converted<IntentionAssessment> from_idl(const msg::TargetIntention& in) {
  Checks checks;
  IntentionAssessment out;
  check_header(checks, in.header());
  checks.count("intentions", in.intentions().size(), 1, kMaxIntentions);
  checks.in_range("obstacle_distance_m", in.obstacle_distance_m(), 0.0, limits::kPosition_m);
  checks.in_range("body_turn_angle_rad", in.body_turn_angle_rad(), -kPi, kPi);
  out.region = read_region(checks, in.region_now());
  out.region_ahead = read_region(checks, in.region_ahead());
  if (!checks.ok()) return checks.result(out);
  double sum = 0.0;
  std::uint32_t seen = 0;  // a bit a place
  for (const auto& row : in.intentions()) {
    const IntentionBelief belief = read_belief(checks, row);
    sum += belief.probability;
    const auto id = intention_named(std::string_view(row.name().c_str()));
    if (!id) {
      ++out.unknown;
      continue;
    }
    const std::uint32_t bit = 1U << index_of(*id);
    if (seen & bit) checks.fail("intentions.name", row.name().c_str(), "each only once");
    seen |= bit;
    out[*id] = belief;
  }
  checks.sums_to_one("intentions.probability", sum);
  out.count = kIntentionCount;
  out.margins = margin_scores(out);
  out.stamp_s = seconds(in.header().stamp());
  out.obstacle_distance_m = in.obstacle_distance_m();
  out.body_turn_rad = in.body_turn_angle_rad();
  return checks.result(out);
}

void to_idl(const Prediction& in, msg::TargetPrediction& out) {
  set_header(out.header(), in.stamp_s);
  out.status(static_cast<std::uint8_t>(in.status));
  out.expansions(static_cast<std::uint32_t>(in.expansions));
  if (in.paths.size() > kMaxPaths) throw std::length_error("TargetPrediction.paths: above 16");
  out.paths().resize(in.paths.size());
  for (std::size_t i = 0; i < in.paths.size(); ++i) {
    const PredictedPath& path = in.paths[i];
    auto& row = out.paths()[i];
    row.name(std::string(row_of(path.intention).name));
    row.color_rgb(row_of(path.intention).color_rgb);
    row.probability(path.probability);
    if (path.states.size() > kMaxStates)
      throw std::length_error("TargetPrediction.paths.states: above 64");
    row.states().resize(path.states.size());
    for (std::size_t k = 0; k < path.states.size(); ++k) {
      auto& state = row.states()[k];
      state.time_from_stamp_s(path.states[k].time_s);
      state.position_m(to_array(path.states[k].position_enu_m));
      state.velocity_mps(to_array(path.states[k].velocity_enu_m_s));
      state.covariance_xy_m2(to_rows<2>(path.states[k].covariance_m2));
    }
  }
}

Converted<Prediction> from_idl(const msg::TargetPrediction& in) {
  Checks checks;
  Prediction out;
  check_header(checks, in.header());
  checks.enumerator("status", in.status(), statuses::STATUS_SEARCH_EXHAUSTED);
  checks.count("paths", in.paths().size(), in.status() == statuses::STATUS_OK ? 1 : 0, kMaxPaths);
  if (!checks.ok()) return checks.result(std::move(out));
  out.stamp_s = seconds(in.header().stamp());
  out.status = static_cast<PredictionStatus>(in.status());
  out.expansions = static_cast<int>(in.expansions());
  double sum = 0.0;
  for (const auto& path : in.paths()) {
    out.paths.push_back(read_path(checks, path));
    sum += path.probability();
  }
  if (!in.paths().empty()) checks.sums_to_one("paths.probability", sum);
  return checks.result(std::move(out));
}

}  // namespace foretrack
