// SPDX-License-Identifier: Apache-2.0
#include "services/common/roles.hpp"

#include <algorithm>
#include <array>

namespace foretrack {

const char* name_of(Role role) {
  switch (role) {
    case Role::kVehicle:
      return "vehicle";
    case Role::kGate:
      return "gate";
    case Role::kFrontEnd:
      return "front_end";
    case Role::kAutopilot:
      return "autopilot";
    case Role::kOperator:
      return "operator";
    case Role::kViewer:
      return "viewer";
    case Role::kRecorder:
      return "recorder";
    case Role::kSimulator:
      return "simulator";
  }
  return "";
}

std::optional<Role> role_of(std::string_view name) {
  for (const Role role : kRoles)
    if (name == name_of(role)) return role;
  return std::nullopt;
}

std::vector<Role> roles_of_service(std::string_view service) {
  constexpr std::array<std::string_view, 6> kStages = {"perception", "mapping", "prediction",
                                                       "planning",   "fleet",   "stages"};
  if (std::ranges::find(kStages, service) != kStages.end()) return {Role::kVehicle};
  if (service == "safety_gate") return {Role::kGate};
  if (service == "simulator" || service == "replay") return {Role::kSimulator};
  if (service == "order" || service == "up" || service == "demo") return {Role::kOperator};
  if (service == "station") return {Role::kOperator, Role::kViewer};
  if (service == "record") return {Role::kRecorder, Role::kViewer, Role::kOperator};
  return {Role::kViewer, Role::kOperator};
}

}  // namespace foretrack
