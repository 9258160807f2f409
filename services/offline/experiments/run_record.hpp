// SPDX-License-Identifier: Apache-2.0
// What is kept of one flight: numbers and small tables, not its rows.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "core/scores/score_intentions.hpp"
#include "services/offline/experiments/flight_job.hpp"
#include "services/offline/experiments/path_record.hpp"
#include "services/offline/flight/encounters.hpp"
#include "services/offline/flight/fleet_metrics.hpp"
#include "services/offline/flight/fly_pilot.hpp"
#include "services/offline/flight/hidings.hpp"

namespace foretrack {

/// One event: it succeeded or not. For kWalk the whole flight is the event.
struct EventOutcome {
  double begin_s = 0.0;
  bool success = false;
  double min_distance_m = 0.0;
  double longest_loss_s = 0.0;
  bool collided = false;
};

/// Distance to the target around an event, every kCurveStep_s from kCurveFrom_s to kCurveTo_s.
inline constexpr double kCurveFrom_s = -1.0, kCurveTo_s = 4.0, kCurveStep_s = 0.1;
using DistanceCurve = std::vector<float>;  // NaN beyond the flight

/// One moment of a flight, for the view from above.
struct ViewPoint {
  float time_s = 0.0f;
  std::array<float, 2> vehicle_m{}, target_m{};
  bool visible = true;
};

/// Where the target was in the vehicle's frame (x forward, y left, by its yaw): cells of 0.1 m.
struct RelativePlaces {
  static constexpr double kCell_m = 0.1, kMinX_m = -1.0, kMinY_m = -3.0;
  static constexpr int kCells = 60;  // on each axis
  std::vector<std::uint32_t> cells = std::vector<std::uint32_t>(kCells * kCells, 0);  // x fastest
  double count = 0.0, x = 0.0, y = 0.0, xx = 0.0, xy = 0.0, yy = 0.0;                 // sums

  void add(const Vec2& p);
  RelativePlaces& operator+=(const RelativePlaces& other);
  /// Area of the ellipse that would hold 90 % of a normal distribution with this covariance.
  double ellipse_area_m2() const;
};

struct RunRecord {
  std::string log_sha256;
  Metrics metrics;
  double mean_speed_m_s = 0.0;  // of the walking target
  std::vector<double> plan_ms;
  std::vector<EventOutcome> events;
  std::vector<DistanceCurve> curves;  // one for each event; none for kWalk
  RelativePlaces places;
  IntentionScorer intentions;
  PathScorer paths;
  std::vector<ViewPoint> view;  // every 0.1 s
  std::optional<Encounter> staged;
  std::vector<EncounterRecord> encounters;  // where one was staged
  std::vector<HidingRecord> hidings;        // the same
  std::optional<FleetMetrics> fleet;  // where the scenario has vehicles; the rest is the first's
  double longest_hover_s = 0.0;

  bool failed() const;
};

/// An encounter succeeds if no wall and nobody is touched, and the person's floor is kept. Its
/// least distance is the gap.
EventOutcome outcome_of(const EncounterRecord& encounter);

/// A hiding succeeds if they are found in time, and untouched. Its loss is until they are found.
EventOutcome outcome_of(const HidingRecord& hiding);

/// The events of that kind, but for encounters and hidings. Passes are turns that begin within 2.5
/// m of the origin.
std::vector<EventOutcome> outcomes_of(const Metrics& metrics, std::span<const FlightRow> rows,
                                      EventKind kind, const MetricParams& params);

/// log_csv: of the flight's rows.
RunRecord record_of(const FlightResult& flight, std::string_view log_csv, const PathRecord& paths,
                    EventKind kind, const MetricParams& params);

}  // namespace foretrack
