// SPDX-License-Identifier: Apache-2.0
// When people came near the vehicle in a flight, and what it did then.
#pragma once

#include <array>
#include <span>
#include <string_view>
#include <vector>

#include "services/offline/flight/metrics.hpp"

namespace foretrack {

/// How the vehicle went until the gap was least: along the person's way, across it, or up.
enum class Evasion : std::uint8_t { kStayed, kBack, kAside, kUp };
inline constexpr std::array<std::string_view, 4> kEvasionNames = {"stayed", "back", "aside", "up"};

/// From when a person's course would bring them within 1.5 m of the vehicle within 4 s, if both
/// went on as they are, until that has not been so for a second.
struct EncounterRecord {
  int person = 0;  // 0: the followed one; else the bystander of that number
  double begin_s = 0.0, end_s = 0.0;
  double person_speed_m_s = 0.0;  // the greatest
  double least_gap_m = 0.0;       // between the hulls
  double least_gap_s = 0.0;       // when that was
  bool seen = false;              // the camera had the person in sight before that
  bool wall_contact = false;
  Evasion evasion = Evasion::kStayed;
  double longest_loss_s = 0.0;  // of sight of the followed person, evading upward aside
  double evading_s = 0.0;       // upward

  bool contact() const { return least_gap_m <= 0.0; }
};

/// The gap that has to be kept from somebody of this speed; 0 from where only contact counts.
double gap_floor_m(double person_speed_m_s);

/// In the order of their beginnings. Precondition: rows at equal steps.
std::vector<EncounterRecord> encounters_of(std::span<const FlightRow> rows,
                                           const MetricParams& params);

/// The longest time for which the vehicle stood still further from the followed person than it
/// should be, with nobody near who could be in the way.
double longest_hover_s(std::span<const FlightRow> rows, const MetricParams& params);

}  // namespace foretrack
