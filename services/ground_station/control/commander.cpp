#include "services/ground_station/control/commander.hpp"

#include <algorithm>
#include <chrono>

#include "foretrack_msgs/msg/MissionCommand.h"
#include "foretrack_msgs/msg/SafetyState.h"
#include "services/common/clock.hpp"
#include "services/common/topics.hpp"
#include "services/ground_station/bus/channel.hpp"
#include "services/ground_station/control/tokens.hpp"

namespace foretrack::station {
namespace {

using Command = foretrack_msgs::msg::MissionCommand;
using SafetyState = foretrack_msgs::msg::SafetyState;

constexpr double kLease_s = 60.0;
constexpr double kRenew_s = 1.0;     // the gate's own lease lasts 5 s
constexpr double kPatience_s = 2.0;  // for the gate's answer
constexpr double kRepeatStop_s = 0.1;
constexpr double kSimulated_s = 1e8;  // stamps before 1973 are of a simulated clock

bool is_about_lease(MissionOrder order) {
  return order == MissionOrder::kLease || order == MissionOrder::kRelease;
}

std::string wire_name(const std::string& vehicle) {
  Names names;
  names.vehicle = vehicle;
  return topic_name(topics::MissionCommand::info, names);
}

std::unique_ptr<RawWriter> make_writer(Node& node, const std::string& topic) {
  return std::make_unique<RawWriter>(node, RawTopic{topic, TypeName<Command>::value, false},
                                     topics::MissionCommand::info.profile);
}

}  // namespace

Commander::Commander(std::shared_ptr<Node> node, bool may_order,
                     std::function<void(const std::string&)> on_writer)
    : node_(std::move(node)), may_order_(may_order), on_writer_(std::move(on_writer)) {}
Commander::~Commander() = default;

void Commander::move_to(std::shared_ptr<Node> node) {
  for (auto& [name, vehicle] : vehicles_)
    if (vehicle.writer) vehicle.writer = make_writer(*node, wire_name(name));
  node_ = std::move(node);
}

void Commander::hear(const std::string& name, const CdrBytes& bytes, double now_s) {
  SafetyState state;
  if (!from_cdr(type_ops<SafetyState>(), bytes, &state)) return;
  auto& vehicle = vehicles_[name];
  if (may_order_ && !vehicle.writer) {
    const auto topic = wire_name(name);
    vehicle.writer = make_writer(*node_, topic);
    on_writer_(topic);
  }
  auto& mission = vehicle.mission;
  mission.lease_operator = state.lease_operator().c_str();
  mission.lease_expires_s = state.lease_remaining_s();
  vehicle.lease_heard_s = now_s;
  vehicle.stamp_s = to_seconds(state.header().stamp());
  vehicle.stopped = state.phase() == static_cast<std::uint8_t>(MissionPhase::kStopped);
  if (state.command() > static_cast<std::uint8_t>(MissionOrder::kRelease) ||
      state.command_result() > static_cast<std::uint8_t>(MissionResult::kRefusedForeign))
    return;
  const auto order = static_cast<MissionOrder>(state.command());
  const auto result = static_cast<MissionResult>(state.command_result());
  if (!is_about_lease(order) && state.command_id() != 0) {
    const bool ok = result == MissionResult::kAccepted;
    mission.command_id = state.command_id();
    mission.command = to_string(order);
    mission.operator_name = state.operator_id().c_str();
    mission.result = ok ? "accepted" : "refused";
    mission.reason = ok ? "" : to_string(result);
  }
  settle(vehicle, state.command_id(), result);
}

void Commander::settle(Vehicle& vehicle, std::uint64_t command_id, MissionResult result) {
  std::vector<std::pair<Report, Outcome>> done;
  std::erase_if(vehicle.pending, [&](Pending& p) {
    const bool answered = std::find(p.sent.begin(), p.sent.end(), command_id) != p.sent.end();
    if (!answered && !(p.order == MissionOrder::kStop && !p.sent.empty() && vehicle.stopped))
      return false;
    const bool ok = !answered || result == MissionResult::kAccepted;
    done.emplace_back(std::move(p.report), Outcome{ok, ok ? "" : std::string(to_string(result))});
    return true;
  });
  for (const auto& [report, outcome] : done) report(outcome);
}

std::uint64_t Commander::next_id() {
  const auto now_us = static_cast<std::uint64_t>(now_ns() / 1000);
  return last_id_ = std::max(now_us, last_id_ + 1);
}

void Commander::send(Vehicle& vehicle, Pending& pending, double now_s) {
  const bool simulated = vehicle.stamp_s < kSimulated_s;
  const double stamp_s = simulated ? vehicle.stamp_s + (now_s - vehicle.lease_heard_s)
                                   : static_cast<double>(now_ns()) * 1e-9;
  Command command;
  command.header().stamp(to_stamp(stamp_s));
  command.id(pending.sent.empty() ? pending.id : next_id());
  command.command(static_cast<std::uint8_t>(pending.order));
  command.operator_id(pending.name);
  command.lease_id(pending.lease_id);
  pending.sent.push_back(command.id());
  pending.next_s = pending.order == MissionOrder::kStop ? now_s + kRepeatStop_s : 1e18;
  vehicle.writer->write(to_cdr(type_ops<Command>(), &command));
}

void Commander::order(Vehicle& vehicle, MissionOrder order, const std::string& name,
                      const std::string& lease_id, double now_s, Report report) {
  Pending pending;
  pending.id = next_id();
  pending.order = order;
  pending.name = name;
  pending.lease_id = lease_id;
  pending.deadline_s = now_s + kPatience_s;
  pending.next_s = now_s;
  pending.report = std::move(report);
  vehicle.pending.push_back(std::move(pending));
  if (vehicle.writer->readers() > 0) send(vehicle, vehicle.pending.back(), now_s);
}

Commander::Vehicle* Commander::find(const std::string& name, const Report& report) {
  const auto it = vehicles_.find(name);
  if (it != vehicles_.end() && it->second.writer) return &it->second;
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
  const auto id = random_hex(16);
  order(*vehicle, MissionOrder::kLease, who, id, now_s,
        [vehicle, who, id, now_s, report = std::move(report)](const Outcome& outcome) {
          if (outcome.ok) vehicle->lease = Lease{who, id, now_s + kLease_s, now_s};
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
  const auto id = vehicle->lease->id;
  vehicle->lease.reset();
  order(*vehicle, MissionOrder::kRelease, who, id, now_s, std::move(report));
}

void Commander::hand_over(const std::string& name, const std::string& who, const std::string& to,
                          double now_s, Report report) {
  auto* vehicle = find(name, report);
  if (!vehicle) return;
  if (!vehicle->lease || vehicle->lease->name != who)
    return report({false, who + " does not hold the lease"});
  // The secret stays the station's, so the gate sees its holder renew it under a new name.
  order(*vehicle, MissionOrder::kLease, to, vehicle->lease->id, now_s,
        [vehicle, to, now_s, report = std::move(report)](const Outcome& outcome) {
          if (outcome.ok && vehicle->lease) {
            vehicle->lease->name = to;
            vehicle->lease->until_s = now_s + kLease_s;
          }
          report(outcome);
        });
}

void Commander::command(const std::string& name, MissionOrder what, const std::string& who,
                        double now_s, Report report) {
  auto* vehicle = find(name, report);
  if (!vehicle) return;
  auto& lease = vehicle->lease;
  const bool holds = lease && lease->name == who;
  if (!holds && what != MissionOrder::kStop) {
    const auto& holder = lease ? lease->name : vehicle->mission.lease_operator;
    return report({false, holder.empty() ? "take the lease first" : holder + " holds the lease"});
  }
  if (holds) lease->until_s = now_s + kLease_s;
  order(*vehicle, what, who, holds ? lease->id : "", now_s, std::move(report));
}

// Not while an order waits for its answer: the gate tells of its last one only.
void Commander::renew(Vehicle& vehicle, double now_s) {
  auto& lease = vehicle.lease;
  if (!lease || !vehicle.pending.empty() || now_s - lease->renewed_s < kRenew_s) return;
  lease->renewed_s = now_s;
  const bool over = now_s > lease->until_s;
  const Lease current = *lease;
  if (over) lease.reset();
  order(vehicle, over ? MissionOrder::kRelease : MissionOrder::kLease, current.name, current.id,
        now_s, [&vehicle](const Outcome& outcome) {
          if (!outcome.ok && outcome.reason == to_string(MissionResult::kRefusedForeign))
            vehicle.lease.reset();  // it ran out unheard, and somebody else took it
        });
}

void Commander::tick(double now_s) {
  for (auto& [name, vehicle] : vehicles_) {
    if (!vehicle.writer) continue;
    std::vector<std::pair<Report, Outcome>> late;
    for (auto& pending : vehicle.pending)
      if (now_s >= pending.next_s && vehicle.writer->readers() > 0) send(vehicle, pending, now_s);
    std::erase_if(vehicle.pending, [&](Pending& p) {
      if (now_s < p.deadline_s) return false;
      late.emplace_back(std::move(p.report), Outcome{false, "the safety gate did not answer"});
      return true;
    });
    for (const auto& [report, outcome] : late) report(outcome);
    renew(vehicle, now_s);
  }
}

std::map<std::string, MissionStatus> Commander::missions(double now_s) const {
  std::map<std::string, MissionStatus> result;
  for (const auto& [name, vehicle] : vehicles_) {
    auto mission = vehicle.mission;
    mission.lease_expires_s =
        std::max(0.0, mission.lease_expires_s - (now_s - vehicle.lease_heard_s));
    if (vehicle.lease) mission.lease_expires_s = std::max(0.0, vehicle.lease->until_s - now_s);
    if (mission.lease_expires_s == 0.0) mission.lease_operator.clear();
    result[name] = mission;
  }
  return result;
}

}  // namespace foretrack::station
