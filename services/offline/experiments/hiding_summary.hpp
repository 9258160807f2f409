// SPDX-License-Identifier: Apache-2.0
// People who hid and were found again, pooled over flights.
#pragma once

#include <string>
#include <vector>

#include "services/offline/experiments/run_record.hpp"

namespace foretrack {

/// All hidings of one kind, hidden for about as long.
struct HidingCell {
  std::string name;  // the kind, or "all"
  std::string method;
  MapSource map = MapSource::kKnown;
  double hidden_from_s = 0.0, hidden_to_s = 0.0;
  int hidings = 0, found = 0;  // within kFindWithin_s
  Interval95 found_95;
  double until_found_p50_s = 0.0, until_found_p90_s = 0.0;  // infinite: never
  int contacts = 0;                                         // with the person
  int wall_contacts = 0;                                    // of their flights
  double least_gap_m = 0.0;
};

/// Kind by kind, then all; each by how long they hid (2–5, 5–12, 12–20 s and longer).
std::vector<HidingCell> summarize_hidings(const std::vector<FlightJob>& jobs,
                                          const std::vector<RunRecord>& records);

/// A list; times that are infinite are null.
std::string hidings_json_of(const std::vector<HidingCell>& cells);

/// One line a hiding, with the command that flies it again.
std::string hidings_csv_of(const std::vector<FlightJob>& jobs,
                           const std::vector<RunRecord>& records);

}  // namespace foretrack
