// SPDX-License-Identifier: Apache-2.0
#include "services/operator/flight_log.hpp"

#include <algorithm>
#include <limits>

#include "services/convert/prediction.hpp"
#include "services/convert/safety.hpp"
#include "services/convert/target.hpp"
#include "services/convert/vehicle.hpp"

namespace foretrack {
namespace {

constexpr double kSameStamp_s = 1e-6;
constexpr std::size_t kMostImages = 100;
constexpr double kGap_s = 0.5;  // a longer one in the truth is not bridged

// Where the most probable path is some seconds after now.
Vec2 ahead(const Prediction& prediction, double seconds) {
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  if (prediction.paths.empty()) return Vec2::Constant(kNaN);
  const auto& states = prediction.paths.front().states;
  for (std::size_t i = 1; i < states.size(); ++i) {
    if (states[i].time_s < seconds) continue;
    const auto& a = states[i - 1];
    const auto& b = states[i];
    const double share = std::clamp((seconds - a.time_s) / (b.time_s - a.time_s), 0.0, 1.0);
    return ((1.0 - share) * a.position_enu_m + share * b.position_enu_m).head<2>();
  }
  return Vec2::Constant(kNaN);
}

PersonState person_of(const VehicleState& truth) {
  PersonState person;
  person.stamp_s = truth.stamp_s;
  person.position_enu_m = truth.position_enu_m;
  person.velocity_enu_m_s = truth.velocity_enu_m_s;
  person.body_yaw_rad = truth.yaw_rad();
  return person;
}

}  // namespace

FlightLog::FlightLog(const Scenario& scenario, std::function<double()> wall_s)
    : scenario_(scenario), world_(world_of(scenario)), wall_s_(std::move(wall_s)) {
  now_.foresight_m.fill(Vec2::Constant(std::numeric_limits<double>::quiet_NaN()));
}

void FlightLog::attach(Hooks& hooks) {
  hooks.color_image = [this](double stamp_s) { hear_image(stamp_s); };
  hooks.vehicle_truth = [this](const auto& m) { hear_vehicle(m); };
  hooks.target_truth = [this](const auto& m) { hear_target(m); };
  hooks.target = [this](const auto& m) {
    if (const auto state = from_idl(m)) now_.estimate = *state;
  };
  hooks.intention = [this](const auto& m) {
    if (const auto assessment = from_idl(m)) now_.beliefs = assessment->beliefs;
  };
  hooks.prediction = [this](const auto& m) { hear_prediction(m); };
  hooks.plan = [this](const auto& m) { hear_plan(m); };
  hooks.safety = [this](const auto& m) { hear_safety(m); };
}

void FlightLog::hear_image(double stamp_s) {
  if (!wall_s_) return;
  if (images_.size() == kMostImages) images_.pop_front();
  images_.push_back({stamp_s, wall_s_()});
}

void FlightLog::hear_vehicle(const nav_msgs::msg::Odometry& odometry) {
  const auto state = from_idl(odometry);
  if (!state) return;
  vehicle_.add(*state);
  add_rows();
}

void FlightLog::hear_target(const nav_msgs::msg::Odometry& odometry) {
  const auto state = from_idl(odometry);
  if (!state) return;
  target_.add(*state);
  add_rows();
}

void FlightLog::hear_prediction(const foretrack_msgs::msg::TargetPrediction& m) {
  stage_ms_["predict"].push_back(m.compute_ms());
  const auto prediction = from_idl(m);
  if (!prediction) return;
  for (std::size_t i = 0; i < kForesight_s.size(); ++i)
    now_.foresight_m[i] = ahead(*prediction, kForesight_s[i]);
}

void FlightLog::hear_plan(const foretrack_msgs::msg::PlannedTrajectory& plan) {
  ++plans_;
  now_.planned = true;
  now_.plan_status = static_cast<PlanStatus>(plan.status());
  now_.plan_reason = static_cast<PlanReason>(plan.reason());
  now_.plan_id = plan.id();
  double total_ms = 0.0;
  for (const auto& stage : plan.stage_times()) {
    if (stage.stage() == "total") continue;
    stage_ms_["plan: " + stage.stage().to_string()].push_back(stage.ms());
    total_ms += stage.ms();
  }
  stage_ms_["plan"].push_back(total_ms);
}

void FlightLog::hear_safety(const foretrack_msgs::msg::SafetyState& m) {
  const auto report = from_idl(m);
  if (!report) return;
  now_.autopilot = report->autopilot;
  now_.mode = to_string(report->result.mode);
  now_.setpoint = report->result.setpoint;
  if (now_.setpoint && report->caused_by_s > last_cause_s_)
    take_latency(report->stamp_s, report->caused_by_s);
}

void FlightLog::take_latency(double stamp_s, double cause_s) {
  last_cause_s_ = cause_s;
  latency_ms_.push_back(1e3 * (stamp_s - cause_s));
  while (!images_.empty() && images_.front().stamp_s < cause_s - kSameStamp_s) images_.pop_front();
  if (images_.empty() || images_.front().stamp_s > cause_s + kSameStamp_s) return;
  wall_latency_ms_.push_back(1e3 * (wall_s_() - images_.front().at_s));
  images_.pop_front();
}

void FlightLog::add_rows() {
  if (!vehicle_.newest() || !target_.newest()) return;
  const double until_s = std::min(vehicle_.newest()->stamp_s, target_.newest()->stamp_s);
  if (first_s_ < 0.0) first_s_ = next_s_ = until_s;
  if (until_s - next_s_ > kGap_s) next_s_ = until_s;
  for (; next_s_ <= until_s; next_s_ += kStep_s) {
    const auto vehicle = vehicle_.at(next_s_);
    const auto target = target_.at(next_s_);
    if (vehicle && target) add_row(*vehicle, *target);
  }
}

void FlightLog::add_row(const VehicleState& vehicle, const VehicleState& target) {
  FlightRow row = now_;
  now_.planned = false;
  row.now_s = next_s_ - first_s_;
  row.vehicle = vehicle;
  row.vehicle.stamp_s -= first_s_;
  row.estimate.stamp_s -= first_s_;
  row.target = person_of(target);
  row.target.stamp_s -= first_s_;
  row.target_height_m = scenario_.target.person.height_m;
  if (!rows_.empty())
    row.acceleration_enu_m_s2 =
        (vehicle.velocity_enu_m_s - rows_.back().vehicle.velocity_enu_m_s) / kStep_s;
  const auto& camera = scenario_.landmark_camera;
  row.sight = sight_of(world_, camera.camera, row.vehicle, row.target,
                       scenario_.target.person.height_m, camera.range_max_m);
  row.clearance_m = clearance_m(world_, vehicle.position_enu_m);
  rows_.push_back(row);
}

double FlightLog::path_length_m() const {
  double length = 0.0;
  for (std::size_t i = 1; i < rows_.size(); ++i)
    length += (rows_[i].vehicle.position_enu_m - rows_[i - 1].vehicle.position_enu_m).norm();
  return length;
}

}  // namespace foretrack
