// SPDX-License-Identifier: Apache-2.0
#include "services/ground_station/report/vehicle_teller.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/safety/autopilot_watch.hpp"
#include "core/safety/ladder.hpp"
#include "core/safety/mission.hpp"

namespace foretrack::station {
namespace {

using EventKind = StoryEvent::Kind;
namespace msg = foretrack_msgs::msg;
namespace gate_words = foretrack_msgs::msg::SafetyState_Constants;
namespace track_words = foretrack_msgs::msg::TargetState_Constants;

constexpr double kStep_m = 0.25;  // of a track
constexpr double kGap_s = 1.0;    // longer silences are no time of flight
constexpr double kJump_m = 20.0;  // no vehicle goes so far from one sample to the next
constexpr std::size_t kMostPictureBytes = 2u << 20;
constexpr std::size_t kMostPictures = 24;
constexpr std::size_t kMostEvents = 2000;

template <class... Values>
bool are_finite(Values... values) {
  return (std::isfinite(values) && ...);
}

double horizontal_m(const StoryPoint& a, const StoryPoint& b) {
  return std::hypot(a.x_m - b.x_m, a.y_m - b.y_m);
}

// Whether the point was far enough from the last to be one of the track.
bool extend(std::vector<StoryPoint>& track, const StoryPoint& point) {
  const bool far = track.empty() || horizontal_m(track.back(), point) >= kStep_m ||
                   std::abs(track.back().z_m - point.z_m) >= kStep_m;
  if (far) track.push_back(point);
  return far;
}

bool is_jpeg(const std::vector<std::uint8_t>& bytes) {
  return bytes.size() > 3 && bytes.size() < kMostPictureBytes && bytes[0] == 0xFF &&
         bytes[1] == 0xD8;
}

std::string_view order_word(std::uint8_t command) {
  constexpr auto kLast = static_cast<std::uint8_t>(MissionOrder::kSetReturnPlace);
  return command <= kLast ? to_string(static_cast<MissionOrder>(command)) : "an unknown order";
}

bool is_about_lease_only(std::uint8_t command) {
  return command == static_cast<std::uint8_t>(MissionOrder::kLease) ||
         command == static_cast<std::uint8_t>(MissionOrder::kRelease);
}

std::string name_of(std::string who) {
  return who.empty() ? "somebody" : who;
}

bool is_bad_mode(std::uint8_t mode) {
  return mode == gate_words::MODE_BRAKE || mode == gate_words::MODE_SILENT;
}

}  // namespace

void VehicleTeller::note(double time_s, EventKind kind, bool bad, std::string text) {
  if (story_.events.size() < kMostEvents)
    story_.events.push_back({time_s, kind, bad, std::move(text)});
}

void VehicleTeller::take(double time_s, const nav_msgs::msg::Odometry& message) {
  const auto& p = message.pose().pose().position();
  const auto& v = message.twist().twist().linear();
  if (!are_finite(p.x(), p.y(), p.z(), v.x(), v.y(), v.z())) return;
  const StoryPoint point{time_s, p.x(), p.y(), p.z()};
  if (const bool first = story_.track.empty(); extend(story_.track, point) && !first) {
    const auto& before = *(story_.track.end() - 2);
    const double step_m = std::hypot(horizontal_m(before, point), point.z_m - before.z_m);
    if (step_m < kJump_m) story_.flown_m += step_m;
  }
  place_ = point;
  story_.altitude_m.add(point.z_m);
  story_.speed_m_s.add(std::hypot(v.x(), v.y(), v.z()));
}

void VehicleTeller::take(double time_s, const msg::TargetState& message) {
  const auto& p = message.position_m();
  if (message.status() == track_words::STATUS_NONE || !are_finite(p[0], p[1], p[2])) return;
  const StoryPoint point{time_s, p[0], p[1], p[2]};
  const double elapsed_s = time_s - std::exchange(person_time_s_, time_s);
  if (message.status() == track_words::STATUS_TRACKING) {
    if (elapsed_s < kGap_s) story_.seen_s += elapsed_s;
    if (lost_) find(time_s);
    person_ = point;
    seen_before_s_ = time_s;
    extend(story_.person, point);
    if (place_) story_.distance_m.add(horizontal_m(*place_, point));
  } else if (message.status() == track_words::STATUS_LOST && !lost_ && seen_before_s_) {
    lose(time_s);
  }
}

void VehicleTeller::lose(double time_s) {
  lost_ = true;
  StoryLoss loss;
  loss.from_s = *seen_before_s_;
  loss.where = person_;
  if (story_.losses.size() < kMostPictures) loss.picture = picture_;
  story_.losses.push_back(std::move(loss));
  note(time_s, EventKind::kPerson, true, "the person is lost");
}

void VehicleTeller::find(double time_s) {
  lost_ = false;
  story_.losses.back().to_s = time_s;
  wants_found_ = story_.losses.size() <= kMostPictures;
  note(time_s, EventKind::kPerson, false, "the person is seen again");
}

void VehicleTeller::take(double time_s, const sensor_msgs::msg::CompressedImage& message) {
  const std::vector<std::uint8_t> bytes(message.data().begin(), message.data().end());
  if (!is_jpeg(bytes)) return;
  if (std::exchange(wants_found_, false)) story_.losses.back().found = bytes;
  // Those that come while the person is already out of sight show nobody.
  if (!lost_ && (!seen_before_s_ || time_s - *seen_before_s_ < 0.3)) picture_ = bytes;
}

void VehicleTeller::take(double time_s, const msg::SafetyState& message) {
  Gate now;
  now.time_s = time_s;
  now.mode = message.mode();
  now.reason = message.reason();
  now.phase = message.phase();
  now.end = message.mission_end();
  now.armed = message.armed();
  now.command_id = message.command_id();
  now.result = message.command_result();
  now.alarm = message.alarm().c_str();
  now.holder = message.lease_operator().c_str();
  const double elapsed_s = gate_ ? time_s - gate_->time_s : 0.0;
  if (elapsed_s < kGap_s && now.armed) story_.armed_s += elapsed_s;
  if (elapsed_s < kGap_s && now.armed && now.mode == gate_words::MODE_TRACK)
    story_.tracked_s += elapsed_s;
  compare(now, message);
  gate_ = std::move(now);
}

void VehicleTeller::compare(const Gate& now, const msg::SafetyState& message) {
  const Gate before = gate_.value_or(Gate{.mode = 255, .phase = 255});
  const auto tell = [&](EventKind kind, bool bad, std::string text) {
    note(now.time_s, kind, bad, std::move(text));
  };
  if (now.phase != before.phase && now.phase <= gate_words::PHASE_TAKING_OFF)
    tell(EventKind::kMission, false,
         fmt::format("mission: {}", to_string(static_cast<MissionPhase>(now.phase))));
  if ((now.mode != before.mode || now.reason != before.reason) &&
      now.mode <= gate_words::MODE_SILENT && now.reason <= gate_words::REASON_IMAGES) {
    const auto why = to_string(static_cast<SafetyReason>(now.reason));
    tell(EventKind::kMode, is_bad_mode(now.mode) && now.armed,
         fmt::format("gate: {}{}{}", to_string(static_cast<SafetyMode>(now.mode)),
                     now.reason == 0 ? "" : ", ", now.reason == 0 ? "" : why));
  }
  if (now.armed != before.armed) tell(EventKind::kMission, false, now.armed ? "armed" : "disarmed");
  if (now.end != before.end && now.end > 0 && now.end <= gate_words::END_LINK)
    tell(EventKind::kMission, now.end != gate_words::END_DONE,
         fmt::format("mission over: {}", to_string(static_cast<MissionEnd>(now.end))));
  if (now.alarm != before.alarm && !now.alarm.empty()) tell(EventKind::kAlarm, true, now.alarm);
  if (now.holder != before.holder)
    tell(EventKind::kOrder, false,
         now.holder.empty() ? before.holder + " gave up control" : now.holder + " has control");
  tell_order(now, message);
}

void VehicleTeller::tell_order(const Gate& now, const msg::SafetyState& message) {
  const bool is_news = !gate_ || now.command_id != gate_->command_id || now.result != gate_->result;
  if (!is_news || now.command_id == 0 || now.result == gate_words::RESULT_PENDING) return;
  if (now.result > gate_words::RESULT_REFUSED_PLACE) return;
  const auto result = static_cast<MissionResult>(now.result);
  const bool taken = is_accepted(result);
  if (is_about_lease_only(message.command()) && taken) return;
  note(now.time_s, EventKind::kOrder, !taken,
       fmt::format("{} of {}: {}", order_word(message.command()),
                   name_of(message.operator_id().c_str()), to_string(result)));
}

void VehicleTeller::take(double time_s, const msg::MissionCommand& message) {
  if (is_about_lease_only(message.command())) return;
  note(time_s, EventKind::kOrder, false,
       fmt::format("{} orders: {}", name_of(message.operator_id().c_str()),
                   order_word(message.command())));
}

void VehicleTeller::take(double time_s, const msg::ServiceHealth& message) {
  const std::string service = message.service().c_str();
  const bool well = message.state() == msg::ServiceHealth_Constants::STATE_RUNNING;
  const std::string trouble = well ? "" : message.last_error().c_str();
  auto& before = troubles_[service];
  if (trouble == before) return;
  before = trouble;
  note(time_s, EventKind::kService, !well, service + (well ? ": well again" : ": " + trouble));
}

void VehicleTeller::take(double, const msg::MovingBodies& message) {
  if (!place_) return;
  for (const auto& body : message.bodies()) {
    const auto& p = body.position_m();
    if (body.followed() || !are_finite(p[0], p[1])) continue;
    story_.others_m.add(horizontal_m(*place_, {0.0, p[0], p[1], 0.0}));
  }
}

void VehicleTeller::take(double, const px4_msgs::msg::BatteryStatus& message) {
  const double remaining = message.remaining();
  if (!(remaining >= 0.0 && remaining <= 1.0)) return;
  if (!story_.battery_begin) story_.battery_begin = remaining;
  story_.battery_end = remaining;
}

VehicleStory VehicleTeller::finish() {
  return std::move(story_);
}

}  // namespace foretrack::station
