// SPDX-License-Identifier: Apache-2.0
// The predictions of a flight, a few a second, kept until the truth is known.
#pragma once

#include <span>

#include "core/scores/score_paths.hpp"
#include "services/offline/flight/flight_row.hpp"

namespace foretrack {

class PathRecord {
 public:
  /// Takes each prediction as it is made.
  void add(const TargetState& target, const Prediction& prediction);
  PathScorer scores(std::span<const FlightRow> rows) const;

 private:
  struct Shown {
    TargetState target;
    double turn_rate_rad_s = 0.0;
    Prediction prediction;
  };
  std::vector<Shown> shown_;
  HeadingRate heading_rate_;
};

}  // namespace foretrack
