// SPDX-License-Identifier: Apache-2.0
// A story as one page that needs nothing else.
#pragma once

#include <string>

#include "services/ground_station/report/flight_story.hpp"

namespace foretrack::station {

/// HTML with its style, its pictures and a sketch of the map in it; no script, nothing from
/// elsewhere. All that a recording says is escaped.
std::string report_html(const FlightStory& story);

}  // namespace foretrack::station
