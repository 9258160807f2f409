// SPDX-License-Identifier: Apache-2.0
#include "services/convert/order_name.hpp"

namespace foretrack {

std::optional<MissionOrder> order_of(std::string_view name) {
  for (const auto order :
       {MissionOrder::kStart, MissionOrder::kHold, MissionOrder::kResume, MissionOrder::kReturn,
        MissionOrder::kLand, MissionOrder::kStop, MissionOrder::kTakeOff})
    if (to_string(order) == name) return order;
  if (name == "bounds") return MissionOrder::kSetBounds;
  if (name == "follow") return MissionOrder::kFollow;
  if (name == "framing") return MissionOrder::kSetFraming;
  return name == "return_place" ? std::optional(MissionOrder::kSetReturnPlace) : std::nullopt;
}

}  // namespace foretrack
