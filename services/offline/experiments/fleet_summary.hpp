// SPDX-License-Identifier: Apache-2.0
// Fleets, pooled over flights.
#pragma once

#include <string>
#include <vector>

#include "services/offline/experiments/run_record.hpp"

namespace foretrack {

/// All flights of one size of fleet, or of what befalls it.
struct FleetCell {
  std::string name;  // the condition: how many, or what befalls three
  std::string method;
  MapSource map = MapSource::kKnown;
  double speed_m_s = 0.0;
  int flights = 0;
  double union_visibility = 0.0, k2_visibility = 0.0, band_share = 0.0;  // means over flights
  int events = 0, events_seen = 0;  // turns; unseen by all for no longer than kUnseen_s
  Interval95 events_95;
  double longest_unseen_s = 0.0;
  double min_separation_m = 0.0;                     // infinite: nobody was beside another
  double below_separation_s = 0.0, stacked_s = 0.0;  // of all flights
  int contacts = 0, wall_contacts = 0, person_contacts = 0;
  double mutual_occlusion = 0.0, separation_score = 0.0, bytes_per_s = 0.0;  // means
};

inline constexpr double kUnseen_s = 0.5;

/// Of the flights with several vehicles, or one of a fleet's.
std::vector<FleetCell> summarize_fleets(const std::vector<FlightJob>& jobs,
                                        const std::vector<RunRecord>& records);

/// A list; a distance that is infinite is null.
std::string fleets_json_of(const std::vector<FleetCell>& cells);

/// One line a flight, with the command that flies it again.
std::string fleets_csv_of(const std::vector<FlightJob>& jobs,
                          const std::vector<RunRecord>& records);

}  // namespace foretrack
