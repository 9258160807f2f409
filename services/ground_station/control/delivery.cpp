// SPDX-License-Identifier: Apache-2.0
#include "services/ground_station/control/delivery.hpp"

#include <algorithm>
#include <utility>

#include "foretrack_msgs/msg/MissionCommand.h"
#include "services/common/clock.hpp"
#include "services/convert/safety.hpp"
#include "services/ground_station/bus/channel.hpp"

namespace foretrack::station {
namespace {

constexpr double kConfirm_s = 1.0;   // in which a gate that hears an order answers
constexpr double kPatience_s = 4.0;  // with the second try; the page waits for 5 s
constexpr double kStopPatience_s = 60.0;
constexpr double kRepeatStop_s = 0.1;
constexpr double kHeard_s = 0.5;          // the gate speaks at 20 Hz
constexpr double kFarthestGuess_s = 0.2;  // less than the gate takes for the future
constexpr double kSimulated_s = 1e8;      // stamps before 1973 are of a simulated clock

Unconfirmed unconfirmed_order(const MissionCommand& command, bool still_sent) {
  return {std::string(to_string(command.order)), std::string(command.operator_name.view()),
          still_sent};
}

}  // namespace

bool is_about_lease(MissionOrder order) {
  return order == MissionOrder::kLease || order == MissionOrder::kRelease;
}

std::uint64_t Delivery::next_id() {
  const auto now_us = static_cast<std::uint64_t>(now_ns() / 1000);
  return last_id_ = std::max(now_us, last_id_ + 1);
}

bool Delivery::stops() const {
  return std::any_of(pending_.begin(), pending_.end(),
                     [](const Pending& p) { return p.command.order == MissionOrder::kStop; });
}

void Delivery::order(const MissionCommand& what, Key key, double now_s, Report report) {
  Pending pending;
  pending.id = next_id();
  pending.command = what;
  pending.key = std::move(key);
  pending.since_s = pending.next_s = now_s;
  pending.report = std::move(report);
  pending_.push_back(std::move(pending));
  if (writer_->readers() > 0) send(pending_.back(), now_s);
}

// Of the gate's clock where it is simulated, which may run slower than ours, or stand: orders must
// seem to be given neither in the future nor before one another.
double Delivery::next_stamp_s(double now_s) {
  if (gate.stamp_s >= kSimulated_s) return static_cast<double>(now_ns()) * 1e-9;
  const double guess_s = gate.stamp_s + std::min(now_s - gate.at_s, kFarthestGuess_s);
  const bool anew = sent_stamp_s_ > guess_s + kHeard_s;  // the simulation began again
  sent_stamp_s_ = anew ? guess_s : std::max(guess_s, sent_stamp_s_);
  return sent_stamp_s_;
}

void Delivery::send(Pending& pending, double now_s) {
  foretrack_msgs::msg::MissionCommand command;
  to_idl(pending.command, command);
  command.header().stamp(to_stamp(next_stamp_s(now_s)));
  command.id(pending.sent.empty() ? pending.id : next_id());
  if (pending.key) pending.key->sign(vehicle_, command);
  pending.sent.push_back(command.id());
  pending.next_s = pending.command.order == MissionOrder::kStop ? now_s + kRepeatStop_s : 1e18;
  const auto bytes = to_cdr(type_ops<foretrack_msgs::msg::MissionCommand>(), &command);
  writer_->write(bytes);
  if (former_ && pending.command.order == MissionOrder::kStop) former_->write(bytes);
}

void Delivery::settle(std::uint64_t command_id, MissionResult result) {
  std::vector<std::pair<Report, Outcome>> done;
  std::erase_if(pending_, [&](Pending& p) {
    const bool answered = std::find(p.sent.begin(), p.sent.end(), command_id) != p.sent.end();
    if (answered && result == MissionResult::kPending) {
      p.retried = true;  // a second one would be refused, as the first acts already
      return false;
    }
    if (!answered && !(p.command.order == MissionOrder::kStop && !p.sent.empty() && gate.stopped))
      return false;
    const bool ok = !answered || is_accepted(result);
    gave_up_.reset();
    if (!p.report) return true;
    done.emplace_back(std::move(p.report), Outcome{ok, ok ? "" : std::string(to_string(result))});
    return true;
  });
  for (const auto& [report, outcome] : done) report(outcome);
}

// Sends once more what was not answered; and if the gate is heard, it is the way to it that fails.
void Delivery::doubt(double now_s, const std::function<void(MissionOrder)>& on_unanswered) {
  for (auto& pending : pending_) {
    if (pending.retried || now_s - pending.since_s < kConfirm_s) continue;
    pending.retried = true;
    pending.next_s = now_s;
    if (now_s - gate.at_s < kHeard_s) on_unanswered(pending.command.order);
  }
}

// Whoever gave the order is told. A STOP goes on.
void Delivery::expire(double now_s) {
  std::vector<std::pair<Report, Outcome>> late;
  std::erase_if(pending_, [&](Pending& p) {
    const bool is_stop = p.command.order == MissionOrder::kStop;
    if (now_s - p.since_s < kPatience_s) return false;
    if (p.report)
      late.emplace_back(std::exchange(p.report, nullptr),
                        Outcome{.reason = is_stop ? "the safety gate did not answer: STOP goes on"
                                                  : "the safety gate did not answer",
                                .answered = false});
    if (is_stop && now_s - p.since_s < kStopPatience_s) return false;
    if (!is_about_lease(p.command.order)) gave_up_ = unconfirmed_order(p.command, false);
    return true;
  });
  for (const auto& [report, outcome] : late) report(outcome);
}

void Delivery::tick(double now_s, const std::function<void(MissionOrder)>& on_unanswered) {
  doubt(now_s, on_unanswered);
  const int readers = writer_->readers() + (former_ ? former_->readers() : 0);
  for (auto& pending : pending_)
    if (now_s >= pending.next_s && readers > 0) send(pending, now_s);
  expire(now_s);
}

void Delivery::move_to(std::unique_ptr<RawWriter> writer) {
  former_ = stops() ? std::move(writer_) : nullptr;
  writer_ = std::move(writer);
  for (auto& pending : pending_) pending.next_s = 0.0;
}

bool Delivery::needs_former() {
  if (!stops()) former_.reset();
  return former_ != nullptr;
}

// A lease that a vehicle out of reach does not confirm is no news.
std::optional<Unconfirmed> Delivery::unconfirmed(double now_s) const {
  for (const auto& p : pending_) {
    if (now_s - p.since_s < kConfirm_s) continue;
    if (is_about_lease(p.command.order) && now_s - gate.at_s > kHeard_s) continue;
    return unconfirmed_order(p.command, true);
  }
  return gave_up_;
}

}  // namespace foretrack::station
