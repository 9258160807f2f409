// SPDX-License-Identifier: Apache-2.0
#include "services/onboard/safety_gate/safety_gate_service.hpp"

#include "core/safety/command_of.hpp"
#include "services/convert/px4.hpp"
#include "services/convert/px4_command.hpp"
#include "services/convert/px4_health.hpp"
#include "services/convert/safety.hpp"
#include "services/convert/trajectory.hpp"
#include "services/onboard/safety_gate/px4_odometry.hpp"

namespace foretrack {
namespace {

// Found here, where all from_idl are declared.
constexpr auto convert = [](auto&& message) {
  return from_idl(std::forward<decltype(message)>(message));
};

constexpr double kTick_s = 0.01;
constexpr double kReport_s = 0.05;
constexpr std::size_t kMaxOrders = 8;

}  // namespace

SafetyGateService::SafetyGateService(Service& service, const SafetyParams& params)
    : service_(service),
      params_(params),
      vehicle_(service),
      plan_reader_(service.node()),
      autopilot_reader_(service.node()),
      flags_reader_(service.node()),
      order_reader_(service.node()),
      setpoint_(service.node()),
      heartbeat_(service.node()),
      request_(service.node()),
      report_(service.node()) {
  Loop& loop = service.loop();
  loop.on_newest(plan_reader_, convert,
                 [this](PlannedTrajectory&& plan) { plan_ = std::move(plan); });
  loop.on_newest(autopilot_reader_, convert, [this](const AutopilotStatus& status) {
    autopilot_ = status;
    autopilot_.stamp_s = service_.clock().now_s();  // its clock need not be ours
  });
  loop.on_each(flags_reader_, [this](const px4_msgs::msg::FailsafeFlags& flags) {
    hindrance_ = what_hinders_offboard(flags);
  });
  loop.on_each(order_reader_, convert, [this](MissionCommand&& command) {
    if (orders_.size() < kMaxOrders) orders_.push_back(std::move(command));
  });
  loop.every(kTick_s, [this] { tick(); });
}

void SafetyGateService::tick() {
  const double now_s = service_.clock().now_s();
  const double ticks_s = service_.clock().simulated() ? now_s : service_.clock().steady_s();
  if (ticks_s < ticked_s_) state_ = GateState();  // a simulation was started anew
  ticked_s_ = ticks_s;
  start_simulation(now_s);
  GateInput in;
  in.now_s = ticks_s;
  in.stamp_now_s = now_s;
  const auto arrival = [&](double stamp_s) { return ticks_s - std::max(now_s - stamp_s, 0.0); };
  in.autopilot = autopilot_;
  if (autopilot_.stamp_s >= 0.0) in.autopilot_at_s = arrival(autopilot_.stamp_s);
  if (const VehicleState* vehicle = vehicle_.newest()) {
    in.vehicle = *vehicle;
    in.vehicle_at_s = arrival(vehicle->stamp_s);
  }
  if (plan_) in.plan = &*plan_;
  if (!orders_.empty()) in.command = &orders_.front();
  const GateResult result = gate(state_, in, params_);
  if (in.command) orders_.pop_front();
  plan_.reset();
  command_autopilot(result, now_s);
  publish(result, now_s);
  last_ = result;
}

// What is simulated begins by itself, with an order as any other.
void SafetyGateService::start_simulation(double now_s) {
  if (!service_.clock().simulated() || state_.idle_since_s >= 0.0) return;
  orders_.push_back({.id = 1, .stamp_s = now_s, .order = MissionOrder::kStart});
}

void SafetyGateService::command_autopilot(const GateResult& result, double now_s) {
  if (result.heartbeat) {
    to_heartbeat(now_s, heartbeat_.sample());
    heartbeat_.write();
  }
  if (result.setpoint) {
    to_idl(*result.setpoint, setpoint_.sample());
    setpoint_.write();
  }
  if (const auto command = command_of(result.request, autopilot_.system_id)) {
    to_idl(*command, now_s, request_.sample());
    request_.write();
  }
}

bool SafetyGateService::is_news(const GateResult& r) const {
  return r.mode != last_.mode || r.reason != last_.reason || r.plan_id != last_.plan_id ||
         r.command_id != last_.command_id || r.end != last_.end ||
         r.command_result != last_.command_result || r.phase != last_.phase ||
         r.request != AutopilotRequest::kNone;
}

void SafetyGateService::publish(const GateResult& result, double now_s) {
  if (!is_news(result) && std::abs(now_s - reported_s_) < kReport_s) return;
  reported_s_ = now_s;
  const bool flies = result.mode == SafetyMode::kTrack || result.mode == SafetyMode::kCoast;
  const double age_s = vehicle_.newest() ? vehicle_.age_s(now_s) : -1.0;
  const auto& lease = state_.mission.lease;
  const bool held = lease.is_held(ticked_s_);
  const GateReport report{now_s,
                          flies ? state_.flown.stamp_s : 0.0,
                          result,
                          autopilot_,
                          age_s,
                          state_.order.last.order,
                          std::string(state_.order.last.operator_name.view()),
                          held ? std::string(lease.operator_name.view()) : "",
                          held ? lease.until_s - ticked_s_ : 0.0,
                          autopilot_.offboard ? "" : hindrance_};
  to_idl(report, report_.sample());
  report_.write();
  const bool silent = result.mode == SafetyMode::kSilent;
  service_.health().set_degraded(silent ? std::string(to_string(result.reason)) : "");
}

void run_safety_gate(const ServiceOptions& options, const SafetyParams& params, Stop& stop) {
  Service service("safety_gate", options, stop);
  std::optional<Px4Odometry> odometry;
  if (options.px4_odometry) odometry.emplace(service);
  SafetyGateService stage(service, params);
  service.run();
}

}  // namespace foretrack
