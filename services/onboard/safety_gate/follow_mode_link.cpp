// SPDX-License-Identifier: Apache-2.0
#include "services/onboard/safety_gate/follow_mode_link.hpp"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <random>
#include <utility>

#include "services/common/px4_releases.hpp"
#include "services/convert/px4_mode.hpp"

namespace foretrack {
namespace {

using State = ModeRegistration::State;

std::string_view release_of(Service& service) {
  const auto& release = service.node().options().names.px4_release;
  return release.empty() ? kPx4ReleaseOfIdl : std::string_view(release);
}

constexpr double kMatch_s = 0.3;  // in which the other side has matched us, too

// Requests of another start of ours must not be taken for this one's.
std::uint64_t random_id() {
  std::random_device random;
  return (std::uint64_t{random()} << 32) | random();
}

}  // namespace

FollowModeLink::FollowModeLink(Service& service)
    : service_(service),
      reply_reader_(service.node()),
      check_reader_(service.node()),
      request_(service.node()),
      check_(service.node()),
      completed_(service.node()),
      unregister_(service.node()) {
  Loop& loop = service.loop();
  loop.on_each(reply_reader_, [this](const px4_msgs::msg::RegisterExtComponentReply& reply) {
    take_answer(reply);
  });
  loop.on_newest(check_reader_, [this](const px4_msgs::msg::ArmingCheckRequest& request) {
    if (is_registered()) answer(request);
  });
}

FollowModeLink::~FollowModeLink() {
  if (!is_registered()) return;
  to_unregistration(registration_.numbers, service_.clock().now_s(), unregister_.sample());
  unregister_.write();
}

bool FollowModeLink::is_registered() const {
  return registration_.state == State::kRegistered;
}

void FollowModeLink::hear(const px4_msgs::msg::VehicleStatus& message, AutopilotStatus& status) {
  selectable_ = message.can_set_nav_states_mask();
  has_taken_off_ = message.takeoff_time() != 0;
  if (is_registered() && has_taken_off_) mark_own_mode(message, registration_.numbers.mode, status);
}

void FollowModeLink::take_answer(const px4_msgs::msg::RegisterExtComponentReply& reply) {
  if (!answers(reply, request_.sample())) return;
  const auto answer = from_idl(reply, release_of(service_));
  if (!answer) reply_reader_.refuse(answer.fault());
  answer_ = answer ? *answer : RegistrationAnswer{};
}

void FollowModeLink::answer(const px4_msgs::msg::ArmingCheckRequest& request) {
  const bool can_run = has_taken_off_ && hindrance_ == ModeHindrance::kNone;
  to_reply(request, registration_.numbers, can_run, service_.clock().now_s(), check_.sample());
  check_.write();
}

void FollowModeLink::update(const GateResult& result, const AutopilotStatus& status, bool heard,
                            double stamp_s) {
  hindrance_ = result.mode_hindrance;
  reason_ = result.mode_reason;
  const State before = registration_.state;
  const double now_s = service_.clock().steady_s();
  const bool hears_us = heard && request_.readers() > 0 && reply_reader_.writers() > 0;
  if (!hears_us || matched_s_ < 0.0 || now_s < matched_s_) matched_s_ = now_s;
  const RegistrationInput input{now_s, now_s - matched_s_ > kMatch_s, status.armed, selectable_,
                                std::exchange(answer_, {})};
  if (register_mode(registration_, input)) ask(stamp_s);
  if (registration_.state != before && registration_.state != State::kAsked)
    spdlog::info("safety_gate: mode {}: {}", kModeName, to_string(registration_.state));
  tell_end(result, status, stamp_s);
}

void FollowModeLink::ask(double stamp_s) {
  to_registration(random_id(), release_of(service_), stamp_s, request_.sample());
  request_.write();
}

// Whoever runs modes one after the other goes on. What a pilot or a failsafe ends is known to them.
void FollowModeLink::tell_end(const GateResult& result, const AutopilotStatus& status,
                              double stamp_s) {
  const bool flies = is_registered() && status.own_mode && result.setpoint.has_value();
  const bool ordered =
      result.phase == MissionPhase::kReturning || result.phase == MissionPhase::kLanding;
  const bool gives_up = result.mode_hindrance == ModeHindrance::kSilent;
  if (flew_ && !flies && (ordered || gives_up)) {
    to_completed(registration_.numbers, ordered, stamp_s, completed_.sample());
    completed_.write();
  }
  flew_ = flies;
}

std::string FollowModeLink::words() const {
  if (!is_registered())
    return fmt::format("mode {}: {}; offboard mode stays", kModeName,
                       to_string(registration_.state));
  if (!has_taken_off_) return fmt::format("mode {} cannot be selected: take off first", kModeName);
  if (hindrance_ == ModeHindrance::kNone) return "";
  const auto why =
      to_string(hindrance_ == ModeHindrance::kNotReady || hindrance_ == ModeHindrance::kSilent
                    ? ModeHindrance::kNone
                    : hindrance_);
  return fmt::format("mode {} cannot be selected: {}", kModeName,
                     why.empty() ? to_string(reason_) : why);
}

}  // namespace foretrack
