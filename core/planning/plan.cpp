// SPDX-License-Identifier: Apache-2.0
#include "core/planning/plan.hpp"

#include <algorithm>
#include <limits>
#include <optional>

#include "core/planning/motion/fall_back.hpp"
#include "core/planning/optimize/assemble_problem.hpp"
#include "core/planning/report_plan.hpp"
#include "core/planning/see/target_samples.hpp"

namespace foretrack {
namespace {

constexpr double kRetrySlowdown = 1.4;  // of the first guess's times in the second attempt
constexpr double kFirm = 10.0;          // of the hard limits' weights from the second attempt on
constexpr double kSoft = 50.0;          // by which sight and distance weigh less in the third
constexpr double kStands_m_s = 0.02;
constexpr double kDistanceStep_s = 0.1;

bool is_finite(const PlanInput& in) {
  return std::isfinite(in.now_s) && in.vehicle.position_enu_m.allFinite() &&
         in.vehicle.velocity_enu_m_s.allFinite() && in.vehicle.q_world_body.coeffs().allFinite() &&
         in.vehicle.angular_velocity_body_rad_s.allFinite();
}

bool is_finite(const TargetState& target) {
  return target.position_enu_m.allFinite() && target.velocity_enu_m_s.allFinite() &&
         std::isfinite(target.stamp_s);
}

// One replan: the paper's steps, then the check and what happens if it fails.
class Replan {
 public:
  Replan(PlanningState& state, const PlanInput& in, const PlanningParams& params)
      : s_(state), in_(in), params_(params), clock_(state.clock_s) {
    if (!s_.reserved) reserve(s_);
    next().diagnostics = {};
  }

  const PlanResult& run() {
    if (!is_finite(in_) || in_.map == nullptr || in_.map->empty()) return refuse();
    if (in_.now_s - in_.vehicle.stamp_s > params_.horizon.vehicle_stale_s) return refuse();
    start_ = from_ = choose_start(flown().trajectory, in_.vehicle, in_.now_s, params_);
    const PlanReason reason = follow();
    return reason == PlanReason::kOk ? publish() : fall_back(reason);
  }

 private:
  PlanResult& flown() { return s_.results[s_.flown]; }
  PlanResult& next() { return s_.results[1 - s_.flown]; }

  // The paper's §V. kOk: next() passed the check.
  PlanReason follow() {
    if (const PlanReason reason = believe(); reason != PlanReason::kOk) return reason;
    if (lost()) {  // the person whom it does not see may be near
      if (too_fast()) return brake();
      search_slowly();
    }
    const PlanReason reason = lead_on();
    if (reason == PlanReason::kOk || !start_.on_flown) return reason;
    brake_first();
    return lead_on() == PlanReason::kOk ? PlanReason::kOk : reason;
  }

  // A way from there to places that see the target, and the flight along it.
  PlanReason lead_on() {
    align(s_.belief, from_.time_s, params_.horizon, s_.expected);
    const Vec3& z_1 = s_.expected.paths[0].positions_enu_m.front();
    const FlightSurface surface =
        choose_flight_surface(*in_.map, from_.state.position, z_1, params_);
    const SearchContext context = search_context(surface);
    look_ahead(context, from_.state.position, from_.state.velocity, s_.expected, in_.intention,
               clock_, s_.ahead);
    make_flight_path(context, s_.ahead.way, from_.state.velocity.norm(), s_.path_workspace,
                     s_.path);
    clock_.lap(PlanStage::kPath);
    const bool clear = build_corridor(context, s_.path, s_.corridor, s_.problem.corridor);
    guess_trajectory(context, s_.path, from_, s_.expected, s_.problem);
    make_samples(context, s_.expected, s_.ahead, s_.path_workspace, from_.state, score_decelerate(),
                 s_.problem.samples);
    if (stop_) align(s_.belief, start_.time_s, params_.horizon, s_.expected);
    clock_.lap(PlanStage::kCorridor);
    // A corridor that only touches an obstacle may still hold a way: the check decides.
    const PlanReason reason = optimize();
    return reason != PlanReason::kOk && !clear ? PlanReason::kEmptyCorridor : reason;
  }

  // The motion so far may leave no room to turn into the way: then it comes to rest before.
  void brake_first() {
    stop_ = make_stop_tail(start_.state, params_.limits).piece;
    from_.time_s = start_.time_s + stop_->duration_s;
    from_.state = {stop_->position(stop_->duration_s), Vec3::Zero(), Vec3::Zero()};
  }

  // The second attempt is slower and firmer; the third hardly cares for sight and distance. The
  // result is the reason why the first one failed.
  PlanReason optimize() {
    const PlanReason reason = attempt(params_.optimizer);
    if (reason == PlanReason::kOk) return reason;
    be_careful();
    OptimizerParams careful = params_.optimizer;
    careful.corridor_weight *= kFirm;
    careful.speed_weight *= kFirm;
    careful.acceleration_weight *= kFirm;
    if (may_be_flown(attempt(careful))) return PlanReason::kOk;
    careful.visibility_weight /= kSoft;
    careful.next_visibility_weight /= kSoft;
    careful.distance_weight /= kSoft;
    return may_be_flown(attempt(careful)) ? PlanReason::kOk : reason;
  }

  bool may_be_flown(PlanReason reason) {
    return reason == PlanReason::kOk || (reason == PlanReason::kTooNearTarget && retreats());
  }

  // The target comes too near whatever is planned: rather away from it than on as before.
  bool retreats() {
    const CheckInputs inputs{*in_.map, start_.state, start_.yaw};
    const PlannedTrajectory& candidate = next().trajectory;
    if (!check_trajectory(candidate, inputs, params_.limits, params_.check).ok()) return false;
    return !start_.on_flown ||
           least_target_distance_m(candidate, 0.0) >
               least_target_distance_m(flown().trajectory,
                                       start_.time_s - flown().trajectory.start_s);
  }

  double least_target_distance_m(const PlannedTrajectory& trajectory, double from_s) const {
    const ExpectedPath& path = s_.expected.paths[0];
    double least_m = std::numeric_limits<double>::infinity();
    for (double t_s = 0.0; t_s <= params_.horizon.horizon_s; t_s += kDistanceStep_s)
      least_m = std::min(least_m, distance_xy(trajectory.position(from_s + t_s),
                                              path.position(t_s, params_.horizon.step_s)));
    return least_m;
  }

  // Takes in the prediction, or remembers the last one while a lost target is searched for.
  PlanReason believe() {
    if (in_.target.usable() && is_finite(in_.target)) {
      // Out of sight, the target goes on as its intentions were; constant velocity knows less.
      if (in_.target.status == TrackStatus::kTracking || !s_.seen_before)
        update_belief(s_.belief, in_.target, in_.prediction, params_.horizon);
      s_.seen_before = true;
      s_.lost_since_s = -1.0;
      return PlanReason::kOk;
    }
    if (!s_.seen_before) return PlanReason::kNoTarget;
    if (s_.lost_since_s < 0.0) begin_search();
    return searching() ? PlanReason::kOk : PlanReason::kTargetLost;
  }
  // The camera turns on round the side where the target was going.
  void begin_search() {
    s_.lost_since_s = in_.now_s;
    const Vec3& last = s_.belief.paths[0].states.back().position_enu_m;
    const double bearing_rad = yaw_of(Vec2((last - in_.vehicle.position_enu_m).head<2>()));
    s_.search_turn = wrap_angle(bearing_rad - in_.vehicle.yaw_rad()) >= 0.0 ? 1.0 : -1.0;
  }
  void search_slowly() {
    double& most_m_s = params_.limits.speed_max_m_s;
    most_m_s = std::min(most_m_s, params_.view.search_speed_m_s);
  }
  bool too_fast() const {
    const double most_m_s = (1.0 + params_.check.limit_tolerance) * params_.view.search_speed_m_s;
    return start_.state.velocity.norm() > most_m_s;
  }
  bool lost() const { return s_.lost_since_s >= 0.0; }
  bool searching() const { return in_.now_s - s_.lost_since_s < params_.horizon.search_s; }

  double score_decelerate() const {
    const bool counts = in_.intention != nullptr && params_.horizon.intention_margins;
    return counts ? (*in_.intention)[Intention::kDecelerate].score : 0.0;
  }
  // The ring d* is the middle of the band.
  SearchContext search_context(const FlightSurface& surface) const {
    const PlaceParams& place = params_.place;
    const double low_m = place.kept_low_m(score_decelerate());
    const double half_band_m = 0.5 * (place.kept_high_m() - low_m);
    return {*in_.map, surface, params_, low_m + half_band_m,
            std::max(std::min(place.ring_tolerance_m, half_band_m), 0.5 * in_.map->resolution_m)};
  }

  PlanReason attempt(const OptimizerParams& optimizer) {
    PlanDiagnostics& d = next().diagnostics;
    ++d.attempts;
    const OptimizationResult& optimum = optimize_trajectory(s_.optimizer, s_.problem, optimizer);
    d.iterations += optimum.iterations;
    d.evaluations += optimum.evaluations;
    d.cost = optimum.cost;
    clock_.lap(PlanStage::kOptimization);
    if (optimum.status == OptimizationStatus::kNotFinite) return PlanReason::kNotConverged;
    PlannedTrajectory& trajectory = next().trajectory;
    trajectory.pieces.clear();
    if (stop_) trajectory.pieces.push_back(*stop_);
    trajectory.pieces.insert(trajectory.pieces.end(), optimum.pieces.begin(), optimum.pieces.end());
    append_tail(trajectory);
    if (lost() && in_.now_s - s_.lost_since_s > params_.view.search_look_s)
      sweep_camera(start_, s_.search_turn, params_, s_.aim, trajectory);
    else
      aim_camera(start_, s_.expected, params_, s_.aim, trajectory);
    const PlanReason reason = check(trajectory);
    clock_.lap(PlanStage::kCheck);
    return reason;
  }

  void append_tail(PlannedTrajectory& trajectory) {
    trajectory.tail_start_s = trajectory.duration_s();
    const QuinticPiece& last = trajectory.pieces.back();
    const double end_s = last.duration_s;
    const BoundaryState end{last.position(end_s), last.velocity(end_s), last.acceleration(end_s)};
    trajectory.pieces.push_back(make_stop_tail(end, params_.limits).piece);
  }

  PlanReason check(PlannedTrajectory& trajectory) {
    trajectory.start_s = start_.time_s;
    CheckInputs inputs{*in_.map, start_.state, start_.yaw};
    if (!lost() && s_.belief.count > 0) inputs.target_path = &s_.belief.paths[0];
    inputs.target_stamp_s = s_.belief.stamp_s;
    CheckResult& result = next().diagnostics.check;
    result = check_trajectory(trajectory, inputs, params_.limits, params_.check);
    return result.reason;
  }

  // For the second attempt: slower, ending at rest.
  void be_careful() {
    for (double& duration_s : s_.problem.durations_s) duration_s *= kRetrySlowdown;
    s_.problem.goal.velocity.setZero();
  }

  const PlanResult& publish() {
    PlannedTrajectory& t = next().trajectory;
    t.id = ++s_.last_id;
    t.stamp_s = lost() ? s_.belief.stamp_s : in_.target.stamp_s;
    t.status = lost() ? PlanStatus::kSearch : PlanStatus::kFresh;
    t.reason = lost() ? PlanReason::kTargetLost : next().diagnostics.check.reason;
    fill_views(s_, from_.time_s - start_.time_s, params_.horizon.step_s, t);
    count_work(s_, clock_, next().diagnostics);
    s_.flown = 1 - s_.flown;
    return flown();
  }

  // Inputs that nothing can be decided by: what is flown flies on unchecked.
  const PlanResult& refuse() {
    PlanResult& result = flown();
    result.diagnostics = {};
    if (!result.trajectory.pieces.empty()) result.trajectory.status = PlanStatus::kKept;
    result.trajectory.reason = PlanReason::kStaleInput;
    return result;
  }

  // Half a cell less than a new trajectory needs: where the map has not changed, what passed the
  // check must not be braked for because it is looked at from other points.
  double kept_clearance_m() const {
    return params_.check.vehicle_radius_m - 0.5 * in_.map->resolution_m;
  }

  PlanReason brake() {
    make_stop(start_, params_, s_.aim, next().trajectory);
    s_.ahead.views[0].clear();
    resize_polytopes(s_.corridor, s_.problem.corridor, 0);
    const PlanReason reason = check(next().trajectory);
    clock_.lap(PlanStage::kCheck);
    return reason;
  }

  const PlanResult& fall_back(PlanReason reason) {
    PlannedTrajectory& t = flown().trajectory;
    if (start_.on_flown &&
        rest_is_clear(*in_.map, t, start_.time_s - t.start_s, kept_clearance_m())) {
      const bool stands = t.velocity(start_.time_s - t.start_s).norm() < kStands_m_s &&
                          start_.time_s - t.start_s > t.tail_start_s;
      t.status = stands ? PlanStatus::kHold : PlanStatus::kKept;
      t.reason = reason;
      flown().diagnostics = next().diagnostics;
      count_work(s_, clock_, flown().diagnostics);
      return flown();
    }
    brake();
    const PlanResult& result = publish();
    flown().trajectory.status = PlanStatus::kHold;
    flown().trajectory.reason = reason;
    return result;
  }

  PlanningState& s_;
  const PlanInput& in_;
  PlanningParams params_;
  StageClock clock_;
  PlanStart start_;  // of the trajectory
  PlanStart from_;   // of the way that is planned: the same, or where it has come to rest
  std::optional<QuinticPiece> stop_;  // flown before that way
};

}  // namespace

const PlanResult& plan(PlanningState& state, const PlanInput& input, const PlanningParams& params) {
  return Replan(state, input, params).run();
}

}  // namespace foretrack
