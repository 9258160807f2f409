// SPDX-License-Identifier: Apache-2.0
#include "core/planning/evade.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/planning/attempts.hpp"
#include "core/planning/motion/stop_tail.hpp"
#include "core/planning/optimize/quintic_basis.hpp"

namespace foretrack {
namespace {

constexpr int kAzimuths = 8;
constexpr std::array<double, 3> kElevations_rad = {0.0, rad(35.0), rad(65.0)};
constexpr double kRises_rad = rad(60.0);  // where nobody has looked, less stands above than beside
constexpr std::array<double, 3> kLengths_m = {0.6, 1.4, 3.0};
constexpr double kLengthCost_m2s = 2e-4;  // of a squared metre: no further than it helps
constexpr double kClimbCost_m2s = 4e-4;  // the same, of height: beside a person it sees them better
constexpr int kDurations = 14;
constexpr double kLongerBy = 1.15;
constexpr int kLimitSamples = 12;

bool is_within(const QuinticPiece& piece, const FlightLimits& limits) {
  for (int i = 0; i <= kLimitSamples; ++i) {
    const double t_s = piece.duration_s * i / kLimitSamples;
    if (piece.velocity(t_s).norm() > kPlannedShare * limits.speed_max_m_s ||
        piece.acceleration(t_s).norm() > kPlannedShare * limits.acceleration_max_m_s2)
      return false;
  }
  return true;
}

// The quickest least-jerk motion to rest at the end that keeps the limits, of a few durations.
std::optional<QuinticPiece> quickest(const BoundaryState& from, const Vec3& end,
                                     const FlightLimits& limits) {
  const double distance_m = (end - from.position).norm();
  double duration_s = std::max({0.2, 1.875 * distance_m / limits.speed_max_m_s,
                                std::sqrt(5.78 * distance_m / limits.acceleration_max_m_s2)});
  for (int i = 0; i < kDurations; ++i, duration_s *= kLongerBy) {
    const QuinticPiece piece = quintic_between(from, {end, Vec3::Zero(), Vec3::Zero()}, duration_s);
    if (is_within(piece, limits)) return piece;
  }
  return {};
}

// From the body that comes nearest to where the vehicle would stop.
Vec2 direction_away(const Vec3& stop, double time_s, const BodyCourses& courses,
                    const GapParams& params) {
  Vec2 away = Vec2::UnitX();
  double least_m = std::numeric_limits<double>::infinity();
  for (const BodyCourse& course : courses.all())
    for (const double after_s : {0.0, 0.5, 1.0}) {
      const double gap_m =
          expected_gap_m(stop, params.hull_radius_m, course.body, time_s + after_s);
      const Vec2 offset = (stop - course.body.expected_at(time_s + after_s)).head<2>();
      if (gap_m >= least_m || offset.norm() < 1e-3) continue;
      least_m = gap_m;
      away = offset.normalized();
    }
  return away;
}

struct Evasion {
  QuinticPiece piece;
  double cost = 0.0;
};

// All evasions that keep the limits, in the order in which they are made.
class Evasions {
 public:
  static constexpr std::size_t kCapacity =
      1 + kLengths_m.size() * (1 + kAzimuths * kElevations_rad.size());

  Evasions(PlanningState& s, const PlanTask& task, Passable passable)
      : task_(task), courses_(s.courses), scratch_(s.evading), passable_(passable) {
    scratch_.start_s = task.start.time_s;
  }

  void collect() {
    const QuinticPiece stop = make_stop_tail(task_.start.state, task_.limits).piece;
    const Vec3 end = stop.position(stop.duration_s);
    const Vec2 away = direction_away(end, task_.start.time_s, courses_, task_.params.body);
    add(stop, Vec3::Zero());
    for (const double length_m : kLengths_m) {
      offer(end, length_m * Vec3::UnitZ());
      for (const double elevation_rad : kElevations_rad) {
        if (passable_ == Passable::kNotOccupied && elevation_rad < kRises_rad) continue;
        for (int i = 0; i < kAzimuths; ++i) {
          const double azimuth_rad = yaw_of(away) + 2.0 * kPi * i / kAzimuths;
          Vec3 direction;
          direction << std::cos(elevation_rad) * direction_of(azimuth_rad), std::sin(elevation_rad);
          offer(end, length_m * direction);
        }
      }
    }
    std::ranges::sort(found_.begin(), found_.begin() + count_, {}, &Evasion::cost);
  }
  std::span<const Evasion> best_first() const {
    return {found_.data(), static_cast<std::size_t>(count_)};
  }

 private:
  void offer(const Vec3& stop, const Vec3& offset) {
    if (task_.input.map->clearance_m(stop + offset, passable_) <
        task_.params.check.vehicle_radius_m)
      return;
    if (const auto piece = quickest(task_.start.state, stop + offset, task_.limits))
      add(*piece, offset);
  }
  void add(const QuinticPiece& piece, const Vec3& offset) {
    scratch_.pieces.assign(1, piece);
    const BodyGaps gaps = measure_gaps(scratch_, 0.0, courses_, task_.limits, task_.params.body);
    const double detour =
        kLengthCost_m2s * offset.squaredNorm() + kClimbCost_m2s * offset.z() * offset.z();
    found_[count_++] = {piece, gaps.cost + detour};
  }

  const PlanTask& task_;
  const BodyCourses& courses_;
  PlannedTrajectory& scratch_;
  Passable passable_;
  std::array<Evasion, kCapacity> found_;
  int count_ = 0;
};

}  // namespace

std::optional<CheckResult> evade(PlanningState& s, const PlanTask& task, double cost_to_beat,
                                 Passable passable) {
  Evasions evasions(s, task, passable);
  evasions.collect();
  PlannedTrajectory& trajectory = s.evading;
  trajectory.tail_start_s = 0.0;
  for (const Evasion& evasion : evasions.best_first()) {
    if (evasion.cost >= cost_to_beat) break;
    trajectory.pieces.assign(1, evasion.piece);
    aim(s, task, trajectory);
    const CheckResult result = check(s, task, trajectory, passable);
    if (result.ok() || result.reason == PlanReason::kTooNearTarget) return result;
  }
  return {};
}

}  // namespace foretrack
