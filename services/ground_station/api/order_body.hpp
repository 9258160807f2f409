// SPDX-License-Identifier: Apache-2.0
// An order as the page posts it.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "core/safety/mission.hpp"
#include "services/convert/checks.hpp"

namespace foretrack::station {

/// `command`: start, hold, resume, return, land, stop, take_off; or, with more beside it:
///   follow    person_id: a number of bodies; 0: nobody
///   framing   distance_m, height_m, bearing_rad: null or left out: free; circling_radps
///   bounds    fence_m: [[x, y], …]; altitude_min_m, altitude_max_m: null or left out: no bound
///   return_place  position_m: [x, y]
/// Numbers are finite; whether they are safe is the gate's to judge.
Converted<MissionCommand> read_order(const nlohmann::ordered_json& body);

}  // namespace foretrack::station
