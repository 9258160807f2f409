// SPDX-License-Identifier: Apache-2.0
// Encounters with people, pooled over flights.
#pragma once

#include <string>
#include <vector>

#include "services/offline/experiments/run_record.hpp"

namespace foretrack {

/// All encounters of one kind (or in one place), at one speed, on one kind of map.
struct EncounterCell {
  std::string name;  // the kind, or the place
  std::string method;
  MapSource map = MapSource::kKnown;
  double speed_m_s = 0.0;                                  // of those who come near
  int flights = 0, encounters = 0, person_encounters = 0;  // of these, with the followed person
  // Encounters with contact: with the followed person, with a bystander; of these, with somebody
  // whom the camera had not seen.
  int person_contacts = 0, bystander_contacts = 0, unseen_contacts = 0;
  Interval95 contact_95;
  int wall_contacts = 0;  // of the flights
  // The least gap of each encounter; quantiles by the nearest rank. Zeros without encounters.
  double gap_min_m = 0.0, gap_p05_m = 0.0, gap_p25_m = 0.0, gap_p50_m = 0.0, gap_p75_m = 0.0;
  int floor_judged = 0, floor_kept = 0;  // of those with a floor
  Interval95 floor_95;
  std::array<int, kEvasionNames.size()> evasions{};
  int view_kept = 0;  // no loss of more than half a second, evading upward aside
  Interval95 view_95;
  double evading_s = 0.0;
  int hovering_flights = 0;  // stood still instead of following

  int contacts() const { return person_contacts + bystander_contacts; }
};

struct EncounterSummary {
  std::vector<EncounterCell> by_kind, by_place;  // in the order of the jobs; places by name
  bool empty() const { return by_kind.empty(); }
};

/// Of the flights in which encounters were staged.
EncounterSummary summarize_encounters(const std::vector<FlightJob>& jobs,
                                      const std::vector<RunRecord>& records);

/// {"by_kind": […], "by_place": […]}; fields as in docs/metrics.md.
std::string encounters_json_of(const EncounterSummary& summary);

/// One line an encounter, with the command that flies it again.
std::string encounters_csv_of(const std::vector<FlightJob>& jobs,
                              const std::vector<RunRecord>& records);

}  // namespace foretrack
