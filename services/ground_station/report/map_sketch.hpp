// SPDX-License-Identifier: Apache-2.0
// The ways of a vehicle and of its person, from above, as SVG.
#pragma once

#include <string>

#include "services/ground_station/report/flight_story.hpp"

namespace foretrack::station {

/// North up, with a scale; where the person was lost is marked with the loss' number. Empty: nobody
/// moved.
std::string map_sketch(const VehicleStory& vehicle);

}  // namespace foretrack::station
