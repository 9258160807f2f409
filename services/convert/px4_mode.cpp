// SPDX-License-Identifier: Apache-2.0
#include "services/convert/px4_mode.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "services/convert/px4_time.hpp"

namespace foretrack {
namespace {

namespace msg = px4_msgs::msg;

constexpr int kLastCheck = 7;

// Of what PX4 and registered modes agree on.
std::uint16_t agreement_of(std::string_view release) {
  return release == "1.18" ? 2 : 1;
}

std::array<char, 25> padded(std::string_view name) {
  std::array<char, 25> text{};
  std::copy_n(name.begin(), std::min(name.size(), text.size() - 1), text.begin());
  return text;
}

}  // namespace

void to_registration(std::uint64_t id, std::string_view release, double stamp_s,
                     msg::RegisterExtComponentRequest& out) {
  out = {};
  out.timestamp(microseconds(stamp_s));
  out.request_id(id);
  out.name(padded(kModeName));
  out.px4_ros2_api_version(agreement_of(release));
  out.register_arming_check(true);
  out.register_mode(true);
}

bool answers(const msg::RegisterExtComponentReply& reply,
             const msg::RegisterExtComponentRequest& request) {
  return reply.request_id() == request.request_id() && reply.name() == request.name();
}

Converted<RegistrationAnswer> from_idl(const msg::RegisterExtComponentReply& in,
                                       std::string_view release) {
  Checks checks;
  const auto expected = agreement_of(release);
  if (in.px4_ros2_api_version() != expected)
    checks.fail("px4_ros2_api_version", std::to_string(in.px4_ros2_api_version()),
                std::to_string(expected));
  if (!in.success()) return checks.result(RegistrationAnswer{});
  checks.in_range("mode_id", in.mode_id(), kFirstMode, kLastMode);
  checks.in_range("arming_check_id", in.arming_check_id(), 0, kLastCheck);
  return checks.result(RegistrationAnswer{true, {in.mode_id(), in.arming_check_id()}});
}

void to_unregistration(const ModeNumbers& numbers, double stamp_s,
                       msg::UnregisterExtComponent& out) {
  out.timestamp(microseconds(stamp_s));
  out.name(padded(kModeName));
  out.arming_check_id(static_cast<std::int8_t>(numbers.check));
  out.mode_id(static_cast<std::int8_t>(numbers.mode));
  out.mode_executor_id(-1);
}

void to_reply(const msg::ArmingCheckRequest& request, const ModeNumbers& numbers, bool can_run,
              double stamp_s, msg::ArmingCheckReply& out) {
  out = {};
  out.timestamp(microseconds(stamp_s));
  out.request_id(request.request_id());
  out.registration_id(static_cast<std::uint8_t>(numbers.check));
  out.can_arm_and_run(can_run);
  out.mode_req_angular_velocity(true);
  out.mode_req_attitude(true);
  out.mode_req_local_alt(true);
  out.mode_req_local_position(true);
}

void to_completed(const ModeNumbers& numbers, bool done, double stamp_s, msg::ModeCompleted& out) {
  namespace constants = msg::ModeCompleted_Constants;
  out.timestamp(microseconds(stamp_s));
  out.result(done ? constants::RESULT_SUCCESS : constants::RESULT_FAILURE_OTHER);
  out.nav_state(static_cast<std::uint8_t>(numbers.mode));
}

void mark_own_mode(const msg::VehicleStatus& in, int mode, AutopilotStatus& status) {
  status.own_selected = in.nav_state_user_intention() == mode;
  status.own_mode = in.nav_state() == mode;
  if (!status.own_mode) return;
  status.offboard = true;
  status.mode = FlightMode::kOffboard;
}

}  // namespace foretrack
