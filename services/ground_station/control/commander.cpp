// SPDX-License-Identifier: Apache-2.0
#include "services/ground_station/control/commander.hpp"

#include <algorithm>
#include <chrono>
#include <utility>

#include "foretrack_msgs/msg/MissionCommand.h"
#include "foretrack_msgs/msg/SafetyState.h"
#include "services/common/clock.hpp"
#include "services/common/topics.hpp"
#include "services/ground_station/bus/channel.hpp"

namespace foretrack::station {
namespace {

using SafetyState = foretrack_msgs::msg::SafetyState;

constexpr double kLease_s = 60.0;
constexpr double kRenew_s = 1.0;  // the gate's own lease lasts 5 s

std::string wire_name(const std::string& vehicle) {
  Names names;
  names.vehicle = vehicle;
  return topic_name(topics::MissionCommand::info, names);
}

}  // namespace

Commander::Commander(std::shared_ptr<Node> node, bool may_order,
                     std::function<void(const std::string&)> on_writer)
    : node_(std::move(node)), may_order_(may_order), on_writer_(std::move(on_writer)) {}
Commander::~Commander() = default;

// Null: DDS refuses it, as its security does to who may only look. That is told once.
std::unique_ptr<RawWriter> Commander::make_writer(const std::string& name, Vehicle& vehicle) try {
  auto writer = std::make_unique<RawWriter>(
      *node_,
      RawTopic{wire_name(name), TypeName<foretrack_msgs::msg::MissionCommand>::value, false},
      topics::MissionCommand::info.profile);
  vehicle.refused.clear();
  return writer;
} catch (const std::runtime_error& error) {
  vehicle.refused = "this station may not order " + name + ": " + error.what();
  node_->report(vehicle.refused + "; it goes on reading");
  return nullptr;
}

void Commander::move_to(std::shared_ptr<Node> node) {
  former_node_ = std::exchange(node_, std::move(node));
  for (auto& [name, vehicle] : vehicles_) {
    vehicle.refused.clear();
    if (!vehicle.delivery) continue;
    if (auto writer = make_writer(name, vehicle))
      vehicle.delivery->move_to(std::move(writer));
    else
      vehicle.delivery.reset();
  }
  forget_former();
}

void Commander::forget_former() {
  bool needed = false;
  for (auto& [name, vehicle] : vehicles_)
    if (vehicle.delivery) needed |= vehicle.delivery->needs_former();
  if (!needed) former_node_.reset();
}

void Commander::hear(const std::string& name, const CdrBytes& bytes, double now_s) {
  SafetyState state;
  if (!from_cdr(type_ops<SafetyState>(), bytes, &state)) return;
  auto& vehicle = vehicles_[name];
  if (may_order_ && !vehicle.delivery && vehicle.refused.empty()) {
    if (auto writer = make_writer(name, vehicle)) {
      vehicle.delivery.emplace(name, std::move(writer));
      on_writer_(wire_name(name));
    }
  }
  auto& mission = vehicle.mission;
  mission.lease_operator = state.lease_operator().c_str();
  mission.lease_expires_s = state.lease_remaining_s();
  vehicle.heard_s = now_s;
  if (vehicle.delivery)
    vehicle.delivery->gate = {now_s, to_seconds(state.header().stamp()),
                              state.phase() == static_cast<std::uint8_t>(MissionPhase::kStopped)};
  if (state.command() > static_cast<std::uint8_t>(MissionOrder::kSetReturnPlace) ||
      state.command_result() > static_cast<std::uint8_t>(MissionResult::kRefusedPlace))
    return;
  const auto order = static_cast<MissionOrder>(state.command());
  const auto result = static_cast<MissionResult>(state.command_result());
  const bool is_news = result != MissionResult::kPending && state.command_id() != 0;
  if (is_news && !is_about_lease(order)) {
    const bool ok = is_accepted(result);
    mission.command_id = state.command_id();
    mission.command = to_string(order);
    mission.operator_name = state.operator_id().c_str();
    mission.result = ok ? "accepted" : "refused";
    mission.reason = result == MissionResult::kAccepted ? "" : to_string(result);
  }
  if (vehicle.delivery) vehicle.delivery->settle(state.command_id(), result);
}

Commander::Vehicle* Commander::find(const std::string& name, const Report& report) {
  const auto it = vehicles_.find(name);
  if (it != vehicles_.end() && it->second.delivery) return &it->second;
  if (it != vehicles_.end() && !it->second.refused.empty()) {
    report({false, it->second.refused});
    return nullptr;
  }
  report({false, "nothing was heard of the safety gate of '" + name + "'"});
  return nullptr;
}

void Commander::take(const std::string& name, const std::string& who, double now_s, Report report) {
  auto* vehicle = find(name, report);
  if (!vehicle) return;
  auto& lease = vehicle->lease;
  if (lease && lease->name != who) return report({false, lease->name + " holds the lease"});
  if (lease) {
    lease->until_s = now_s + kLease_s;
    return report({true, ""});
  }
  const auto key = std::make_shared<const LeaseKey>();
  vehicle->delivery->order(
      {.order = MissionOrder::kLease, .operator_name = who}, key, now_s,
      [vehicle, who, key, now_s, report = std::move(report)](const Outcome& outcome) {
        if (outcome.ok) vehicle->lease = Lease{who, key, now_s + kLease_s, now_s};
        const auto& holder = vehicle->mission.lease_operator;
        report(outcome.ok || holder.empty() ? outcome
                                            : Outcome{false, holder + " holds the lease"});
      });
}

void Commander::release(const std::string& name, const std::string& who, double now_s,
                        Report report) {
  auto* vehicle = find(name, report);
  if (!vehicle) return;
  if (!vehicle->lease || vehicle->lease->name != who)
    return report({false, who + " does not hold the lease"});
  const auto key = vehicle->lease->key;
  vehicle->lease.reset();
  vehicle->delivery->order({.order = MissionOrder::kRelease, .operator_name = who}, key, now_s,
                           std::move(report));
}

void Commander::hand_over(const std::string& name, const std::string& who, const std::string& to,
                          double now_s, Report report) {
  auto* vehicle = find(name, report);
  if (!vehicle) return;
  if (!vehicle->lease || vehicle->lease->name != who)
    return report({false, who + " does not hold the lease"});
  // The secret stays the station's, so the gate sees its holder renew it under a new name.
  vehicle->delivery->order(
      {.order = MissionOrder::kLease, .operator_name = to}, vehicle->lease->key, now_s,
      [vehicle, to, now_s, report = std::move(report)](const Outcome& outcome) {
        if (outcome.ok && vehicle->lease) {
          vehicle->lease->name = to;
          vehicle->lease->until_s = now_s + kLease_s;
        }
        report(outcome);
      });
}

void Commander::command(const std::string& name, const MissionCommand& what, double now_s,
                        Report report) {
  auto* vehicle = find(name, report);
  if (!vehicle) return;
  const auto who = what.operator_name.view();
  auto& lease = vehicle->lease;
  const bool holds = lease && lease->name == who;
  const bool is_free = !lease && vehicle->mission.lease_operator.empty();
  const bool needs_lease =
      what.order != MissionOrder::kStop && !(what.order == MissionOrder::kLand && is_free);
  if (!holds && needs_lease) {
    const auto& holder = lease ? lease->name : vehicle->mission.lease_operator;
    return report({false, holder.empty() ? "take the lease first" : holder + " holds the lease"});
  }
  if (holds) lease->until_s = now_s + kLease_s;
  vehicle->delivery->order(what, holds ? lease->key : nullptr, now_s, std::move(report));
}

void Commander::tick(double now_s) {
  for (auto& [name, vehicle] : vehicles_) {
    if (!vehicle.delivery) continue;
    vehicle.delivery->tick(now_s, [this, &name = name](MissionOrder order) {
      if (on_unanswered)
        on_unanswered("the safety gate of " + name + " does not answer the order to " +
                      std::string(to_string(order)));
    });
    renew(vehicle, now_s);
  }
  if (former_node_) forget_former();
}

// Not while an order waits for its answer: the gate tells of its last one only.
void Commander::renew(Vehicle& vehicle, double now_s) {
  auto& lease = vehicle.lease;
  if (!lease || !vehicle.delivery->idle() || now_s - lease->renewed_s < kRenew_s) return;
  lease->renewed_s = now_s;
  const bool over = now_s > lease->until_s;
  const Lease current = *lease;
  if (over) lease.reset();
  vehicle.delivery->order(
      {.order = over ? MissionOrder::kRelease : MissionOrder::kLease,
       .operator_name = current.name},
      current.key, now_s, [&vehicle](const Outcome& outcome) {
        if (!outcome.ok && outcome.reason == to_string(MissionResult::kRefusedForeign))
          vehicle.lease.reset();  // it ran out unheard, and somebody else took it
      });
}

std::map<std::string, MissionStatus> Commander::missions(double now_s) const {
  std::map<std::string, MissionStatus> result;
  for (const auto& [name, vehicle] : vehicles_) {
    auto mission = vehicle.mission;
    mission.lease_expires_s = std::max(0.0, mission.lease_expires_s - (now_s - vehicle.heard_s));
    if (vehicle.lease) mission.lease_expires_s = std::max(0.0, vehicle.lease->until_s - now_s);
    if (mission.lease_expires_s == 0.0) mission.lease_operator.clear();
    mission.refused = vehicle.refused;
    if (vehicle.delivery) mission.unconfirmed = vehicle.delivery->unconfirmed(now_s);
    result[name] = mission;
  }
  return result;
}

}  // namespace foretrack::station
