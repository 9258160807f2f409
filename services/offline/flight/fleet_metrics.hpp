// SPDX-License-Identifier: Apache-2.0
// What a flight of several vehicles was worth, from its rows alone. Definitions: docs/metrics.md.
#pragma once

#include <span>
#include <vector>

#include "core/fleet/fleet_params.hpp"
#include "core/scores/truth.hpp"
#include "services/offline/flight/metrics.hpp"

namespace foretrack {

/// One vehicle at one instant.
struct FleetRowMember {
  bool there = true;  // has joined, and not died
  Vec3 position_enu_m = Vec3::Zero();
  bool sees = false;        // the person, truly: in view and not hidden
  bool peer_hides = false;  // another vehicle is what hides the person from it
  double distance_m = 0.0;  // to the person, horizontally
  int seat = -1;            // that it holds
  bool is_near = false;     // it is the one in the band
};

/// All of them.
struct FleetRow {
  double now_s = 0.0;
  Vec3 person_enu_m = Vec3::Zero();  // the torso's centre
  std::vector<FleetRowMember> members;
  double told_bytes = 0.0;  // by all of them in this step
};

/// How one turn or stop of the person went for the fleet.
struct FleetEvent {
  double begin_s = 0.0;
  double longest_unseen_s = 0.0;  // by all at once, in [−1, +4] s
};

struct FleetMetrics {
  int vehicles = 0;
  double union_visibility = 0.0;    // share of the time in which somebody sees the person
  double k2_visibility = 0.0;       // the same of two or more
  double longest_unseen_s = 0.0;    // by all at once
  double band_share = 0.0;          // of the time in which one of them is in the band
  double mutual_occlusion = 0.0;    // share of vehicles' time with a vehicle in the line of sight
  double min_separation_m = 0.0;    // hull to hull; infinite with one
  double below_separation_s = 0.0;  // nearer than what is promised
  int contacts = 0;                 // of two vehicles
  int wall_contacts = 0, person_contacts = 0;  // of all vehicles
  double stacked_s = 0.0;                      // one below another one, within 2 m
  double separation_score =
      0.0;            // mean least angle between two, as seen from the person, of an even one
  int handovers = 0;  // of the place in the band
  double bytes_per_s = 0.0;  // told by each vehicle, without headers of the network
  std::vector<FleetEvent> events;
};

struct FleetMetricParams {
  double vehicle_radius_m = 0.25;
  double separation_m = 1.0;
  double downwash_m = 2.0;
  double band_low_m = 1.5, band_high_m = 2.5;
};

/// What counts as near and far, by the parameters that are flown with.
FleetMetricParams fleet_metric_params_of(const MetricParams& metrics, const FleetParams& params);

/// Whether a vehicle's hull is in the line of sight from an eye to the person, or nearly.
bool hides(const Vec3& hull_enu_m, const Vec3& eye_enu_m, const Vec3& person_enu_m);

/// Precondition: rows at equal steps, with the same vehicles. events: the person's, in time order.
FleetMetrics fleet_metrics_of(std::span<const FleetRow> rows, std::span<const TruthEvent> events,
                              const FleetMetricParams& params);

}  // namespace foretrack
