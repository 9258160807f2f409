// SPDX-License-Identifier: Apache-2.0
#include "services/onboard/safety_gate/safety_gate_service.hpp"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <fstream>

#include "services/common/px4_releases.hpp"
#include "services/convert/bodies.hpp"
#include "services/convert/map.hpp"
#include "services/convert/order_proof.hpp"
#include "services/convert/safety.hpp"
#include "services/convert/trajectory.hpp"
#include "services/onboard/safety_gate/memory_file.hpp"
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
constexpr double kSilence_s = 0.5;       // of a writer, before another one is heard
constexpr double kMapSilence_s = 3.0;    // maps come seldom
constexpr double kOrderSilence_s = 1.5;  // a lease is renewed once a second
constexpr double kAlarm_s = 5.0;         // that it lasts after its cause

// Two vehicles, or one in two domains, must not share their memory.
std::filesystem::path state_file_of(const ServiceOptions& options, std::string_view what) {
  if (options.state_folder.empty()) return {};
  return std::filesystem::path(options.state_folder) /
         fmt::format("{}-{}-{}", what, options.domain_id, options.names.vehicle);
}

// As which release the flight controller spoke last: a gate that is started anew in flight has no
// time to listen for it. Empty: not known.
std::string remembered_release(const std::filesystem::path& file) {
  std::string release;
  std::ifstream(file) >> release;
  const bool known = std::ranges::find(kPx4Releases, release) != std::end(kPx4Releases);
  return known ? release : "";
}

// What the station's page shows before a take-off, and how far its sliders go.
void tell_operators(Health& health, SafetyParams params) {
  for (const ParamRow& row : rows(params))
    if (row.name.ends_with("_reaction") || row.name.starts_with("framing_") ||
        row.name == "battery_reserve" || row.name == "link_timeout_s")
      health.set_fact(std::string(row.name), text_of(row));
}

constexpr double kListen_s = 0.5;

}  // namespace

SafetyGateService::SafetyGateService(Service& service, const SafetyParams& params, bool dry_run,
                                     const std::filesystem::path& memory_file)
    : service_(service),
      params_(params),
      dry_run_(dry_run),
      memory_(memory_file),
      autopilot_(service, dry_run),
      vehicle_(service),
      plan_reader_(service.node()),
      map_reader_(service.node()),
      bodies_reader_(service.node()),
      peers_reader_(service.node()),
      order_reader_(service.node()),
      report_(service.node()) {
  remember_start(memory_file);
  tell_operators(service.health(), params);
  vehicle_.pin_writer(kSilence_s);
  plan_reader_.pin_writer(kSilence_s);
  map_reader_.pin_writer(kMapSilence_s);
  bodies_reader_.pin_writer(kSilence_s);
  peers_reader_.pin_writer(kSilence_s);
  order_reader_.take_future_stamps();  // STOP and LAND count whenever they were given,
  order_reader_.notice_second_writers(kOrderSilence_s);  // and from whomever
  Loop& loop = service.loop();
  loop.on_newest(plan_reader_, convert,
                 [this](PlannedTrajectory&& plan) { plan_ = std::move(plan); });
  loop.on_newest(
      map_reader_,
      [this](foretrack_msgs::msg::LocalMap&& map) {
        depth_blind_ = map.camera() != foretrack_msgs::msg::LocalMap_Constants::CAMERA_SEES;
        return from_idl(std::move(map));
      },
      [this](GridMap&& map) {
        map_ = std::move(map);
        map_at_s_ = service_.clock().steady_s();
      });
  loop.on_newest(
      bodies_reader_,
      [this](const foretrack_msgs::msg::MovingBodies& bodies) {
        color_blind_ = bodies.camera() != foretrack_msgs::msg::MovingBodies_Constants::CAMERA_SEES;
        return from_idl(bodies);
      },
      [this](const MovingBodies& bodies) {
        bodies_ = bodies;
        bodies_at_s_ = service_.clock().steady_s();
      });
  loop.on_newest(peers_reader_, convert, [this](const MovingBodies& peers) {
    peers_ = peers;
    peers_at_s_ = service_.clock().steady_s();
  });
  loop.on_each(order_reader_,
               [this](const foretrack_msgs::msg::MissionCommand& order) { hear_order(order); });
  loop.every(kTick_s, [this] { tick(); });
}

void SafetyGateService::remember_start(const std::filesystem::path& memory_file) {
  if (memory_file.empty()) return;
  const auto memory = read_memory(memory_file);
  if (!memory) return;
  restore(state_, *memory, service_.clock().steady_s(), params_);
  spdlog::warn("safety_gate: was restarted: {}", to_string(state_.mission.phase));
}

// The lease's holder is heard of by every order under it, and by its renewal once a second.
void SafetyGateService::hear_order(const foretrack_msgs::msg::MissionCommand& message) {
  auto order = from_idl(message);
  if (!order) return order_reader_.refuse(order.fault());
  if (orders_.size() >= kMaxOrders) return order_reader_.reject("too many orders at a time");
  order->proved = is_proved(service_.node().options().names.vehicle, message);
  if (proves_the_lease(*order)) operator_at_s_ = service_.clock().steady_s();
  notice_source(*order);
  orders_.push_back(*order);
}

bool SafetyGateService::proves_the_lease(const MissionCommand& order) const {
  return order.proved && order.lease_id == state_.mission.lease.id;
}

// The lease's holder may have joined the bus anew.
void SafetyGateService::notice_source(const MissionCommand& order) {
  const auto others = order_reader_.stats().of_second_writers;
  if (others != orders_of_others_ && !proves_the_lease(order)) ++strange_orders_;
  orders_of_others_ = others;
}

// What one of the two said last counts no longer than it would alone.
void SafetyGateService::read_bodies(GateInput& in) {
  if (bodies_) in.bodies = &*bodies_;
  in.bodies_at_s = bodies_at_s_;
  if (!peers_) return;
  const bool tracked = bodies_ && in.now_s - bodies_at_s_ < params_.bodies_stale_s;
  kept_clear_ = all_of(tracked ? *bodies_ : MovingBodies{}, *peers_, in.stamp_now_s);
  in.bodies = &kept_clear_;
  in.bodies_at_s = std::max(bodies_at_s_, peers_at_s_);
}

void SafetyGateService::tick() {
  const double now_s = service_.clock().steady_s();
  if (now_s < now_s_) {  // a simulation was started anew
    state_ = GateState();
    second_writer_s_ = -1e18;
  }
  now_s_ = now_s;
  GateInput in;
  in.now_s = now_s;
  in.stamp_now_s = service_.clock().now_s();
  autopilot_.read(in);
  in.vehicle = vehicle_.last();
  in.vehicle_at_s = vehicle_.arrived_s();
  if (plan_) in.plan = &*plan_;
  if (map_) in.map = &*map_;
  in.map_at_s = map_at_s_;
  read_bodies(in);
  if (!orders_.empty()) in.command = &orders_.front();
  in.operator_at_s = operator_at_s_;
  in.images_blind = is_blind();
  in.writing = memory_.progress();
  const GateResult result = gate(state_, in, params_);
  autopilot_.send(result, in.stamp_now_s);
  if (result.memory_changed) memory_.write(state_.memory);
  if (in.command) orders_.pop_front();
  plan_.reset();
  tell_turn(result);
  publish(result);
  last_ = result;
}

// The log shall answer what an operator asks after a flight: who ended it, and why.
void SafetyGateService::tell_turn(const GateResult& now) const {
  if (now.request != AutopilotRequest::kNone)
    spdlog::info("safety_gate: the flight controller is asked for {}", to_string(now.request));
  if (now.phase == last_.phase && now.end == last_.end) return;
  const bool refused = now.end == MissionEnd::kRefused;
  spdlog::info("safety_gate: {} -> {}{}{}{}", to_string(last_.phase), to_string(now.phase),
               now.end == MissionEnd::kNone ? "" : ": ", to_string(now.end),
               refused ? fmt::format(" {} ({})", to_string(now.asked), to_string(now.answer)) : "");
}

bool SafetyGateService::is_news(const GateResult& r) const {
  return r.mode != last_.mode || r.reason != last_.reason || r.plan_id != last_.plan_id ||
         r.command_id != last_.command_id || r.command_result != last_.command_result ||
         r.phase != last_.phase || r.end != last_.end || r.answer != last_.answer ||
         r.request != AutopilotRequest::kNone;
}

// What a dead process said last counts no longer: its silence has its own reaction.
bool SafetyGateService::is_blind() const {
  return (color_blind_ && now_s_ - bodies_at_s_ < params_.bodies_stale_s) ||
         (depth_blind_ && now_s_ - map_at_s_ < params_.map_stale_s);
}

// Samples of a second writer are not heard, unless they are orders; that there is one is.
std::string SafetyGateService::alarm() {
  const std::array<const EndpointStats*, 6> inputs = {
      &order_reader_.stats(), &plan_reader_.stats(),   &vehicle_.stats(),
      &map_reader_.stats(),   &bodies_reader_.stats(), &peers_reader_.stats()};
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    const auto samples = i == 0 ? strange_orders_ : inputs[i]->rejected_for(kSecondWriter);
    if (samples == second_writers_[i]) continue;
    second_writers_[i] = samples;
    second_writer_s_ = now_s_;
    second_writer_of_ = inputs[i]->topic;
  }
  return now_s_ - second_writer_s_ < kAlarm_s ? "a second writer of " + second_writer_of_ : "";
}

void SafetyGateService::publish(const GateResult& result) {
  if (!is_news(result) && now_s_ - reported_s_ < kReport_s) return;
  reported_s_ = now_s_;
  const bool flies = result.mode == SafetyMode::kTrack || result.mode == SafetyMode::kCoast;
  const auto& lease = state_.mission.lease;
  const bool held = lease.is_held(now_s_);
  GateReport report;
  report.stamp_s = service_.clock().now_s();
  report.caused_by_s = flies ? state_.flown.stamp_s : 0.0;
  report.result = result;
  report.autopilot = autopilot_.status();
  report.odometry_age_s = vehicle_.arrived_s() < 0.0 ? -1.0 : now_s_ - vehicle_.arrived_s();
  report.order = state_.order.last.order;
  report.operator_name = state_.order.last.operator_name.view();
  report.lease_operator = held ? lease.operator_name.view() : "";
  report.lease_remaining_s = held ? lease.until_s - now_s_ : 0.0;
  report.hindrance = autopilot_.hindrance();
  report.alarm = alarm();
  report.dry_run = dry_run_;
  report.home_enu_m = autopilot_.home_enu_m();
  to_idl(report, report_.sample());
  report_.write();
  const bool silent = result.mode == SafetyMode::kSilent;
  std::string trouble = report.alarm;
  if (trouble.empty()) trouble = autopilot_.other_release();
  if (trouble.empty()) trouble = autopilot_.time_fault();
  if (trouble.empty() && silent) trouble = to_string(result.reason);
  service_.health().set_degraded(trouble);
}

namespace {

// Until the stop is requested, or until the flight controller speaks as another release, where
// nobody said as which it would. Returns that one.
std::string run_as_told(const ServiceOptions& options, bool told, const SafetyParams& params,
                        Stop& stop) {
  Service service("safety_gate", options, stop);
  service.show("safety", params);
  std::optional<Px4Odometry> odometry;
  if (options.px4_odometry) odometry.emplace(service);
  SafetyGateService stage(service, params, options.dry_run, state_file_of(options, "gate"));
  std::string better;
  const auto listen = [&] {
    better = stage.better_release();
    if (!better.empty()) service.loop().leave();
  };
  if (!told) service.loop().every_wall(kListen_s, listen);
  service.run();
  return better;
}

}  // namespace

void run_safety_gate(const ServiceOptions& options, const SafetyParams& params, Stop& stop) {
  ServiceOptions own = options;
  const bool told = !options.names.px4_release.empty();
  const auto file = state_file_of(options, "px4-release");
  if (!told) own.names.px4_release = remembered_release(file);
  while (!stop.requested()) {
    const auto better = run_as_told(own, told, params, stop);
    if (better.empty()) continue;
    own.names.px4_release = better;
    std::error_code error;  // where nothing can be kept, it is heard anew each time
    std::filesystem::create_directories(file.parent_path(), error);
    std::ofstream(file) << better;
    spdlog::info("safety_gate: speaks with PX4 {} from now on", better);
  }
}

}  // namespace foretrack
