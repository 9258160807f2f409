// SPDX-License-Identifier: Apache-2.0
// The flight as text: a screen for a terminal, a line for a log.
#pragma once

#include <string>

#include "services/operator/flight_snapshot.hpp"

namespace foretrack {

struct ViewOptions {
  double distance_low_m = 1.5;  // the band that the planner keeps
  double distance_high_m = 2.5;
  bool colors = false;
  double elapsed_s = 0.0;  // since the view began
};

/// Lines without cursor movements; at most 100 columns.
std::string draw(const FlightSnapshot& snapshot, const ViewOptions& options);
/// One line, no control codes.
std::string status_line(const FlightSnapshot& snapshot, const ViewOptions& options);

/// Draws over what it drew before, on a screen of its own, which goes when it goes.
class Screen {
 public:
  Screen();
  ~Screen();
  Screen(const Screen&) = delete;
  Screen& operator=(const Screen&) = delete;
  void show(const std::string& text);
};

/// Whether standard output is a terminal that understands control codes.
bool is_terminal();

}  // namespace foretrack
