// SPDX-License-Identifier: Apache-2.0
#include "services/onboard/safety_gate/autopilot_link.hpp"

#include <fmt/format.h>

#include <cmath>

#include "core/safety/command_of.hpp"
#include "services/common/find_px4.hpp"
#include "services/common/px4_releases.hpp"
#include "services/common/time_now.hpp"
#include "services/convert/px4.hpp"
#include "services/convert/px4_command.hpp"
#include "services/convert/px4_health.hpp"

namespace foretrack {
namespace {

// Found here, where all from_idl are declared.
constexpr auto convert = [](auto&& message) {
  return from_idl(std::forward<decltype(message)>(message));
};

constexpr std::size_t kMaxAcks = 8;
constexpr double kOneWriterSilence_s = 2.0;
constexpr double kLook_s = 1.0;
constexpr double kHeard_s = 2.0;
constexpr double kTimeFault_s = 0.5;  // more than a status can be late
constexpr double kBegins_s = 5.0;  // in which a gate that was started in flight may change its ear

}  // namespace

AutopilotLink::AutopilotLink(Service& service, bool dry_run)
    : service_(service),
      dry_run_(dry_run),
      begun_s_(steady_s()),
      status_reader_(service.node()),
      flags_reader_(service.node()),
      ack_reader_(service.node()),
      sticks_reader_(service.node()),
      battery_reader_(service.node()),
      home_reader_(service.node()),
      position_reader_(service.node()),
      setpoint_(service.node()),
      heartbeat_(service.node()),
      command_(service.node()) {
  status_reader_.pin_writer(kOneWriterSilence_s);
  Loop& loop = service.loop();
  if (service.options().external_mode && !dry_run) follow_mode_.emplace(service);
  loop.on_newest(
      status_reader_,
      [this](const px4_msgs::msg::VehicleStatus& message) {
        auto status = from_idl(message);
        if (status && follow_mode_) follow_mode_->hear(message, *status);
        return status;
      },
      [this](const AutopilotStatus& status) {
        status_ = status;
        status_at_s_ = service_.clock().steady_s();
        const double now_s = service_.clock().now_s();  // 0 until a simulated one is heard
        ahead_s_ = now_s > 0.0 ? status.stamp_s - now_s : 0.0;
      });
  loop.on_each(flags_reader_, [this](const px4_msgs::msg::FailsafeFlags& flags) {
    hindrance_ = what_hinders_offboard(flags);
    silence_alone_ = is_of_our_making(flags, silence_alone_ && status_.failsafe);
  });
  loop.on_each(ack_reader_, [this](const px4_msgs::msg::VehicleCommandAck& m) { hear_answer(m); });
  loop.on_each(sticks_reader_, [this](const px4_msgs::msg::ManualControlSetpoint& m) {
    sticks_moved_ |= sticks_moved(m);
  });
  loop.on_newest(battery_reader_, convert, [this](const BatteryState& b) { battery_ = b; });
  loop.on_newest(home_reader_, convert,
                 [this](const Vec3& home_enu_m) { home_enu_m_ = home_enu_m; });
  loop.on_newest(
      position_reader_,
      [](const px4_msgs::msg::VehicleLocalPosition& m) { return Converted(origin_of(m)); },
      [this](const std::optional<GlobalPlace>& origin) { origin_ = origin; });
  loop.every_wall(kLook_s, [this] { look_at_release(); });
}

void AutopilotLink::look_at_release() {
  const Names& names = service_.node().options().names;
  const auto expected = names.px4_release.empty() ? kPx4ReleaseOfIdl : names.px4_release;
  const auto spoken = px4_release_on(service_.node());
  spoken_release_ = spoken == expected ? std::string_view() : spoken;
  other_release_ = spoken_release_.empty()
                       ? ""
                       : fmt::format(
                             "the flight controller speaks as PX4 {0} does, {1} is expected: "
                             "start with --px4 {0}",
                             spoken, expected);
}

std::string AutopilotLink::time_fault() const {
  if (std::abs(ahead_s_) < kTimeFault_s) return "";
  return fmt::format(
      "the flight controller's stamps are not in this machine's time ({:+.1f} s): its "
      "UXRCE_DDS_SYNCT is to be 1",
      ahead_s_);
}

std::string_view AutopilotLink::better_release() const {
  const double now_s = steady_s();
  const bool heard = status_at_s_ >= 0.0 && service_.clock().steady_s() - status_at_s_ < kHeard_s;
  const bool flies = heard && status_.armed && now_s - begun_s_ > kBegins_s;
  return flies ? std::string_view() : spoken_release_;
}

// Others command the flight controller, too, and their answers come here as well.
void AutopilotLink::hear_answer(const px4_msgs::msg::VehicleCommandAck& message) {
  if (asked_ == AutopilotRequest::kNone || !answers(message, command_.sample())) return;
  if (acks_.size() < kMaxAcks) acks_.push_back({asked_, result_of(message)});
}

void AutopilotLink::read(GateInput& input) {
  input.autopilot = status_;
  // It holds since we were silent: an operator may start again.
  if (silence_alone_ && status_.mode == FlightMode::kHold) input.autopilot.failsafe = false;
  input.autopilot.sticks_moved = std::exchange(sticks_moved_, false);
  input.autopilot_at_s = status_at_s_;
  if (dry_run_ && status_at_s_ >= 0.0) {
    input.autopilot = {.stamp_s = status_.stamp_s,
                       .armed = true,
                       .offboard = true,
                       .mode = FlightMode::kOffboard,
                       .system_id = status_.system_id};
  }
  if (battery_) input.battery = &*battery_;
  if (acks_.empty()) return;
  ack_ = acks_.front();
  acks_.pop_front();
  input.ack = &ack_;
}

std::string AutopilotLink::hindrance() const {
  if (status_.offboard) return "";
  const std::string mode = follow_mode_ ? follow_mode_->words() : "";
  return hindrance_ + (hindrance_.empty() || mode.empty() ? "" : "; ") + mode;
}

void AutopilotLink::send(const GateResult& result, double stamp_s) {
  if (dry_run_) return;
  const double since_s = service_.clock().steady_s() - status_at_s_;
  const bool heard = status_at_s_ >= 0.0 && since_s < kHeard_s;
  if (follow_mode_) follow_mode_->update(result, status_, heard, stamp_s);
  if (result.heartbeat) {
    to_heartbeat(stamp_s, heartbeat_.sample());
    heartbeat_.write();
  }
  if (result.setpoint) {
    to_idl(*result.setpoint, setpoint_.sample());
    setpoint_.write();
  }
  ask(result, stamp_s);
}

void AutopilotLink::ask(const GateResult& result, double stamp_s) {
  if (result.request == AutopilotRequest::kHome)
    return ask_for_home(result.return_place_enu_m, stamp_s);
  const auto command = command_of(result.request, status_.system_id);
  if (!command) return;
  asked_ = result.request;
  to_idl(*command, stamp_s, command_.sample());
  command_.write();
}

// As high as its present home. Where it knows no global position it would refuse.
void AutopilotLink::ask_for_home(const FlightBounds::Corner& place_enu_m, double stamp_s) {
  if (!origin_) {
    acks_.push_back({AutopilotRequest::kHome, CommandResult::kTemporarilyRejected});
    return;
  }
  asked_ = AutopilotRequest::kHome;
  const double z_m = home_enu_m_ ? home_enu_m_->z() : 0.0;
  const GlobalPlace place = global_of(*origin_, {place_enu_m.x_m, place_enu_m.y_m, z_m});
  to_set_home(place, status_.system_id, stamp_s, command_.sample());
  command_.write();
}

}  // namespace foretrack
