// SPDX-License-Identifier: Apache-2.0
#include "services/onboard/fleet/fleet_service.hpp"

#include <spdlog/spdlog.h>

#include "core/fleet/use_fleet.hpp"
#include "services/convert/bodies.hpp"
#include "services/convert/fleet.hpp"
#include "services/convert/fleet_report.hpp"
#include "services/convert/map.hpp"
#include "services/convert/prediction.hpp"
#include "services/convert/px4_health.hpp"
#include "services/convert/safety.hpp"
#include "services/convert/target.hpp"
#include "services/convert/trajectory.hpp"

namespace foretrack {
namespace {

// Found here, where all from_idl are declared.
constexpr auto convert = [](auto&& message) {
  return from_idl(std::forward<decltype(message)>(message));
};

constexpr double kVehicleStale_s = 0.5;  // without odometry nothing is told
constexpr double kPlanStale_s = 1.0;
constexpr double kAlarm_s = 5.0;  // that it lasts after its cause

// What has stopped to come is seen no more.
TargetState as_seen_at(TargetState target, double now_s) {
  if (target.status == TrackStatus::kTracking && now_s - target.stamp_s > kFleetStale_s)
    target.status = TrackStatus::kCoasting;
  return target;
}

}  // namespace

FleetService::FleetService(Service& service, const FleetParams& params,
                           const PlanningParams& planning)
    : service_(service),
      params_(params),
      body_(planning.body),
      vehicle_(service),
      member_reader_(service.node()),
      target_reader_(service.node()),
      intention_reader_(service.node()),
      prediction_reader_(service.node()),
      plan_reader_(service.node()),
      map_reader_(service.node()),
      gate_reader_(service.node()),
      battery_reader_(service.node()),
      member_(service.node()),
      division_(service.node()),
      bodies_(service.node()),
      fused_(service.node()) {
  service.loop().on_each(member_reader_, convert,
                         [this](const FleetMember& message) { take(message); });
  service.loop().every(kFleetPeriod_s, [this] { tick(); });
}

void FleetService::take(const FleetMember& message) {
  const double now_s = service_.clock().now_s();
  if (message.vehicle.view() != service_.options().names.vehicle) {
    if (!heard_any_) spdlog::info("fleet: hears {}", message.vehicle.view());
    heard_any_ = true;
    hear(state_, message, now_s, params_);
    return;
  }
  if (echoes_.has(message.sequence_number, message.stamp_s)) return;
  member_reader_.reject("of another vehicle with this one's name");
  impostor_s_ = now_s;
}

// Maps and predictions are large: alone, nobody needs them.
void FleetService::take_inputs() {
  if (auto target = target_reader_.take_newest_as(convert)) target_ = *target;
  if (auto plan = plan_reader_.take_newest_as(convert)) plan_ = std::move(*plan);
  if (auto gate = gate_reader_.take_newest_as(convert)) flies_ = is_active(gate->result.phase);
  if (auto battery = battery_reader_.take_newest_as(convert)) battery_ = battery->remaining;
  if (!heard_any_) return;
  if (auto intention = intention_reader_.take_newest_as(convert)) intention_ = *intention;
  if (auto next = prediction_reader_.take_newest_as(convert)) prediction_ = std::move(*next);
  if (auto map = map_reader_.take_newest_as(convert)) map_ = std::move(*map);
}

FleetInput FleetService::gather(double now_s) {
  FleetInput in;
  in.now_s = now_s;
  in.vehicle = service_.options().names.vehicle;
  in.frame = service_.options().fleet_frame;
  in.state = *vehicle_.newest();
  in.radius_m = body_.hull_radius_m;
  in.battery = battery_;
  in.flies = flies_;
  in.gap_min_m = body_.gap_min_m;
  in.target = as_seen_at(target_, now_s);
  if (prediction_) in.prediction = &*prediction_;
  if (intention_) in.intention = &*intention_;
  if (plan_ && plan_reader_.age_s() < kPlanStale_s) in.plan = &*plan_;
  if (!map_.empty()) in.map = &map_;
  return in;
}

void FleetService::tick() {
  const double now_s = service_.clock().now_s();
  if (now_s < told_s_ - kRestart_s) state_ = FleetState();  // a simulation was started anew
  take_inputs();
  judge();
  if (vehicle_.age_s(now_s) > kVehicleStale_s) return;
  told_s_ = now_s;
  const FleetResult result = coordinate(state_, gather(now_s), params_);
  tell(result);
  if (heard_any_) tell_stages(result);
}

void FleetService::tell(const FleetResult& result) {
  to_idl(result.message, member_.sample());
  echoes_.add(result.message.sequence_number, result.message.stamp_s);
  member_.write();
}

void FleetService::tell_stages(const FleetResult& result) {
  to_idl(report_of(state_, result), division_.sample());
  division_.write();
  to_idl(result.peers, {}, bodies_.sample());
  bodies_.write();
  const bool others_see = as_seen_at(target_, told_s_).status != TrackStatus::kTracking &&
                          result.target.status == TrackStatus::kTracking;
  if (!others_see) return;
  to_idl(result.target, fused_.sample());
  fused_.write();
}

void FleetService::judge() {
  const double now_s = service_.clock().now_s();
  if (now_s - impostor_s_ < kAlarm_s)
    service_.health().set_degraded("another vehicle says that it is " +
                                   service_.options().names.vehicle);
  else
    service_.health().set_degraded(vehicle_.age_s(now_s) > kVehicleStale_s ? "no odometry" : "");
}

void run_fleet(const ServiceOptions& options, const FleetParams& params,
               const PlanningParams& planning, Stop& stop) {
  Service service("fleet", options, stop);
  service.show("fleet", params);
  FleetService stage(service, params, planning);
  service.run();
}

}  // namespace foretrack
