// SPDX-License-Identifier: Apache-2.0
#include "services/onboard/planning/planning_service.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>

#include "core/planning/stage_clock.hpp"
#include "services/common/time_now.hpp"
#include "services/convert/bodies.hpp"
#include "services/convert/choice.hpp"
#include "services/convert/fleet_report.hpp"
#include "services/convert/map.hpp"
#include "services/convert/prediction.hpp"
#include "services/convert/safety.hpp"
#include "services/convert/search.hpp"
#include "services/convert/target.hpp"
#include "services/convert/trajectory.hpp"
#include "services/convert/visual.hpp"

namespace foretrack {
namespace {

// Found here, where all from_idl are declared.
constexpr auto convert = [](auto&& message) {
  return from_idl(std::forward<decltype(message)>(message));
};

constexpr double kWatchPeriod_s = 0.01;
constexpr double kSearchPeriod_s = 0.2;

// Ids go on growing when the service is started anew.
std::uint64_t first_id() {
  return static_cast<std::uint64_t>(now_ns() / 1'000'000);
}

}  // namespace

PlanningService::PlanningService(Service& service, const PlanningParams& params,
                                 const FleetParams& fleet)
    : service_(service),
      params_(params),
      fleet_params_(fleet),
      vehicle_(service),
      map_reader_(service.node()),
      target_reader_(service.node()),
      intention_reader_(service.node()),
      prediction_reader_(service.node()),
      bodies_reader_(service.node()),
      gate_reader_(service.node()),
      choice_reader_(service.node()),
      division_reader_(service.node()),
      peers_reader_(service.node()),
      told_reader_(service.node()),
      plan_(service.node()),
      search_(service.node()),
      path_(service.node()),
      markers_(service.node()) {
  state_.clock_s = steady_s;
  state_.last_id = first_id();
  service.health().set_fact("distance_low_m", std::to_string(params.place.distance_low_m));
  service.health().set_fact("distance_high_m", std::to_string(params.place.distance_high_m));
  Loop& loop = service.loop();
  loop.on_newest(map_reader_, convert, [this](GridMap&& map) { map_ = std::move(map); });
  loop.on_newest(target_reader_, convert, [this](const TargetState& target) { target_ = target; });
  loop.on_newest(intention_reader_, convert,
                 [this](const IntentionAssessment& intention) { believe(intention); });
  loop.on_newest(bodies_reader_, convert, [this](const MovingBodies& bodies) { bodies_ = bodies; });
  loop.on_newest(choice_reader_, convert, [this](const ChoiceReport& report) {
    waits_ = report.choice.status == ChoiceStatus::kWaiting ||
             report.choice.status == ChoiceStatus::kDoubtful;
  });
  loop.on_newest(division_reader_, convert, [this](const FleetReport& told) {
    place_ = told.place;
    placed_s_ = told.stamp_s;
  });
  loop.on_newest(peers_reader_, convert, [this](const MovingBodies& peers) { peers_ = peers; });
  loop.on_newest(told_reader_, convert, [this](const TargetState& told) { told_ = told; });
  loop.on_newest(gate_reader_, convert, [this](const GateReport& gate) {
    flies_plans_ = flies_plan(gate.result);
    framing_ = gate.result.framing;
  });
  loop.on_newest(prediction_reader_, convert, [this](Prediction&& prediction) {
    prediction_ = std::move(prediction);
    // Not before the last plan has started: the gate keeps but one waiting.
    const double soonest_s = std::max(params_.horizon.plan_period_s, params_.horizon.replan_lead_s);
    if (std::abs(service_.clock().now_s() - planned_s_) >= soonest_s) replan();
  });
  loop.every(kWatchPeriod_s, [this] { replan_if_late(); });
}

// Somebody else's prediction may know intentions that ask for margins which are not known here.
void PlanningService::believe(const IntentionAssessment& intention) {
  if (intention.unknown != (intention_ ? intention_->unknown : 0))
    spdlog::warn("planning: {} intentions of the prediction are not known here", intention.unknown);
  intention_ = intention;
}

void PlanningService::replan_if_late() {
  if (std::abs(service_.clock().now_s() - planned_s_) >= params_.horizon.plan_latest_s) replan();
}

// A fleet that is silent gives no places.
SeatPlace PlanningService::place_at(double now_s) const {
  return std::abs(now_s - placed_s_) < fleet_params_.silent_s ? place_ : SeatPlace{};
}

PlanInput PlanningService::gather(double now_s) {
  PlanInput in;
  in.now_s = now_s;
  in.target = seen_by_any(target_, told_, now_s);
  in.vehicle.stamp_s = -1e9;
  if (const VehicleState* vehicle = vehicle_.newest()) in.vehicle = *vehicle;
  if (intention_) in.intention = &*intention_;
  if (prediction_) in.prediction = &*prediction_;
  in.map = &map_;
  if (bodies_) {
    kept_clear_ = all_of(*bodies_, peers_, now_s);
    in.bodies = &kept_clear_;
  }
  in.flies_plans = flies_plans_;
  in.framing = framing_of(framing_, place_at(now_s), fleet_params_);
  in.waits = waits_;
  return in;
}

std::string PlanningService::missing(const PlanInput& in) const {
  const PlanInput fresh = without_stale(in, params_.horizon);
  if (vehicle_.age_s(in.now_s) > params_.horizon.vehicle_stale_s) return "no odometry";
  if (!fresh.map) return "no map";
  if (in.now_s - in.target.stamp_s > params_.horizon.target_stale_s) return "no target state";
  if (!fresh.prediction) return "no prediction";
  return {};
}

void PlanningService::replan() {
  const double now_s = service_.clock().now_s();
  planned_s_ = now_s;
  const PlanInput input = gather(now_s);
  service_.health().set_degraded(missing(input));
  publish(plan(state_, input, params_));
  tell_search();
}

void PlanningService::tell_search() {
  const double now_s = service_.clock().now_s();
  if (std::abs(now_s - search_told_s_) < kSearchPeriod_s) return;
  search_told_s_ = now_s;
  summarize(state_.search, now_s, params_, summary_);
  to_idl(summary_, search_.sample());
  search_.write();
}

void PlanningService::publish(const PlanResult& result) {
  auto& message = plan_.sample();
  to_idl(result.trajectory, message);
  message.expansions(static_cast<std::uint32_t>(result.diagnostics.expansions));
  message.iterations(static_cast<std::uint32_t>(result.diagnostics.iterations));
  message.stage_times().resize(kPlanStageCount);
  for (int i = 0; i < kPlanStageCount; ++i) {
    message.stage_times()[i].stage(std::string(kPlanStageNames[i]));
    message.stage_times()[i].ms(result.diagnostics.stage_ms[i]);
  }
  plan_.write();
  draw(result.trajectory);
}

void PlanningService::draw(const PlannedTrajectory& plan) {
  if (!drawing_.is_due(service_.clock().now_s())) return;
  if (path_.readers() > 0) {
    to_path(plan, path_.sample());
    path_.write();
  }
  if (markers_.readers() > 0) {
    to_markers(plan, markers_.sample());
    markers_.write();
  }
}

void run_planning(const ServiceOptions& options, const PlanningParams& params,
                  const FleetParams& fleet, Stop& stop) {
  Service service("planning", options, stop);
  service.show("planning", params);
  PlanningService stage(service, params, fleet);
  service.run();
}

}  // namespace foretrack
