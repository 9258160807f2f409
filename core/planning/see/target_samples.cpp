// SPDX-License-Identifier: Apache-2.0
#include "core/planning/see/target_samples.hpp"

#include <algorithm>
#include <cmath>

namespace foretrack {
namespace {

constexpr double kCatchUpAcceleration =
    0.6;  // of the limits, that can be counted on for catching up
constexpr double kCatchUpSpeed = 0.85;

// Where the vehicle can be after t: anywhere within `radius_m` of where it would coast to.
struct Reach {
  Vec2 center;
  double radius_m;
};

Reach reach_at(const BoundaryState& start, const FlightLimits& limits, double t_s) {
  const double acceleration = kCatchUpAcceleration * limits.acceleration_max_m_s2;
  const double speed = kCatchUpSpeed * limits.speed_max_m_s;
  const double ramp_s = std::min(t_s, speed / acceleration);
  return {(start.position + t_s * start.velocity).head<2>(),
          0.5 * acceleration * ramp_s * ramp_s + speed * (t_s - ramp_s)};
}

// The least half angle of a sector at `apex` that some place within reach lies in.
double least_half_angle(const Reach& reach, const Vec3& apex, double bisector_rad) {
  const Vec2 offset = reach.center - apex.head<2>();
  const double distance_m = offset.norm();
  if (distance_m <= reach.radius_m) return 0.0;
  return std::abs(wrap_angle(yaw_of(offset) - bisector_rad)) -
         std::asin(reach.radius_m / distance_m);
}

// Widens the sample's demands to what can be fulfilled from some place within reach.
void widen_to_reach(const Reach& reach, TargetSample& s) {
  const double distance_m = (reach.center - s.target_enu_m.head<2>()).norm();
  s.distance_high_m = std::max(s.distance_high_m, distance_m - reach.radius_m);
  s.distance_low_m = std::min(s.distance_low_m, distance_m + reach.radius_m);
  s.half_angle_rad =
      std::max(s.half_angle_rad, least_half_angle(reach, s.target_enu_m, s.bisector_rad));
  s.next_half_angle_rad = std::max(
      s.next_half_angle_rad, least_half_angle(reach, s.next_target_enu_m, s.next_bisector_rad));
}

class Sampling {
 public:
  Sampling(const SearchContext& context, const ExpectedTarget& expected, const LookAhead& ahead)
      : params_(context.params), expected_(expected), ahead_(ahead) {}

  double time_s(std::size_t k) const { return params_.horizon.step_s * static_cast<double>(k + 1); }
  double weight_of(int i, std::size_t k) const {
    return expected_.paths[i].probability *
           std::exp(-params_.horizon.later_discount_per_s * time_s(k));
  }
  // The weight of this sample and of all that are merged with it.
  double merged_weight(int i, std::size_t k) const {
    double sum = weight_of(i, k);
    for (int j = i + 1; j < expected_.count; ++j)
      if (expected_.owner(j, k, params_.horizon.merge_distance_m) == i) sum += weight_of(j, k);
    return sum;
  }

  TargetSample sample(int i, std::size_t k, double score_decelerate) const {
    const ExpectedPath& path = expected_.paths[i];
    const View& view = ahead_.views[i][k];
    TargetSample s;
    s.time_s = time_s(k);
    s.weight = merged_weight(i, k);
    s.target_enu_m = path.positions_enu_m[k];
    s.has_region = view.seen;
    s.bisector_rad = view.shrunk.bisector_rad;
    s.half_angle_rad = view.shrunk.half_angle_rad;
    if (k + 1 < path.positions_enu_m.size()) {
      const int owner = expected_.owner(i, k + 1, params_.horizon.merge_distance_m);
      const View& next = ahead_.views[owner][k + 1];
      s.has_next = next.seen;
      s.next_target_enu_m = path.positions_enu_m[k + 1];
      s.next_bisector_rad = next.visible.bisector_rad;
      s.next_half_angle_rad = next.visible.half_angle_rad;
    }
    s.distance_high_m = params_.place.kept_high_m();
    s.distance_low_m = params_.place.kept_low_m(score_decelerate);
    return s;
  }

 private:
  const PlanningParams& params_;
  const ExpectedTarget& expected_;
  const LookAhead& ahead_;
};

}  // namespace

void make_samples(const SearchContext& context, const ExpectedTarget& expected,
                  const LookAhead& ahead, const FlightPathWorkspace& timing,
                  const BoundaryState& start, double score_decelerate,
                  std::vector<TargetSample>& samples) {
  const Sampling sampling(context, expected, ahead);
  samples.clear();
  for (std::size_t k = 0; k < ahead.views[0].size(); ++k) {
    const Reach reach = reach_at(start, context.limits, sampling.time_s(k));
    for (int i = 0; i < expected.count; ++i) {
      if (expected.owner(i, k, context.params.horizon.merge_distance_m) != i) continue;
      samples.push_back(sampling.sample(i, k, score_decelerate));
      TargetSample& sample = samples.back();
      widen_to_reach(reach, sample);
      // The way there may be longer than it is far.
      if (i == 0)
        sample.distance_high_m = std::max(
            sample.distance_high_m,
            distance_xy(scheduled_position(ahead.way, timing, k + 1), sample.target_enu_m));
    }
  }
}

}  // namespace foretrack
