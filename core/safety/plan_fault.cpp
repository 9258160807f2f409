// SPDX-License-Identifier: Apache-2.0
#include "core/safety/plan_fault.hpp"

namespace foretrack {

std::string_view to_string(PlanFault fault) {
  constexpr std::array<std::string_view, kPlanFaultCount> names = {
      "",
      "too large",
      "not finite",
      "it began long ago",
      "it begins far ahead",
      "out of order",
      "its pieces do not join",
      "it ends in motion",
      "too fast",
      "it accelerates too hard",
      "it turns too fast",
      "it does not join what is flown",
      "there is no map",
      "too near an obstacle",
      "too near somebody",
      "outside of what may be flown in"};
  return names[static_cast<std::size_t>(fault)];
}

}  // namespace foretrack
