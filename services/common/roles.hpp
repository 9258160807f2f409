// SPDX-License-Identifier: Apache-2.0
// Who somebody on a secured bus is. What each may write stands with the topics (topics.hpp).
#pragma once

#include <optional>
#include <string_view>
#include <vector>

namespace foretrack {

enum class Role {
  kVehicle,    // the stages: perception, mapping, prediction, planning
  kGate,       // the safety gate, which alone commands the flight controller
  kFrontEnd,   // cameras, detectors and state estimators that are not ours
  kAutopilot,  // the flight controller's DDS agent
  kOperator,   // gives orders
  kViewer,     // looks
  kRecorder,   // looks and keeps
  kSimulator,  // stands for sensors, flight controller and person; has an authority of its own
};
inline constexpr Role kRoles[] = {Role::kVehicle,   Role::kGate,     Role::kFrontEnd,
                                  Role::kAutopilot, Role::kOperator, Role::kViewer,
                                  Role::kRecorder,  Role::kSimulator};

/// A set of them.
class Roles {
 public:
  constexpr Roles() = default;
  constexpr Roles(Role role) : bits_(1u << static_cast<unsigned>(role)) {}
  constexpr bool has(Role role) const { return (bits_ & Roles(role).bits_) != 0; }
  constexpr bool empty() const { return bits_ == 0; }
  friend constexpr Roles operator|(Roles a, Roles b) {
    a.bits_ |= b.bits_;
    return a;
  }

 private:
  unsigned bits_ = 0;
};
constexpr Roles operator|(Role a, Role b) {
  return Roles(a) | Roles(b);
}

/// "front_end": also the name of its identity's folder.
const char* name_of(Role role);
/// Of people's input; none: there is no such role.
std::optional<Role> role_of(std::string_view name);
/// What a process of that name (`foretrack NAME`) may be, the first that there is an identity of.
std::vector<Role> roles_of_service(std::string_view service);

}  // namespace foretrack
