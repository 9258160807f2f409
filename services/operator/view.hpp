// SPDX-License-Identifier: Apache-2.0
// The flight as text: a screen for a terminal, a line for a log, JSON for programs.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "services/operator/picture.hpp"

namespace foretrack {

struct ViewOptions {
  double distance_low_m = 1.5;  // the band that the planner keeps
  double distance_high_m = 2.5;
  bool colors = false;
  double elapsed_s = 0.0;  // since the view began
};

/// Lines without cursor movements; at most 100 columns.
std::string draw(const Picture& picture, const ViewOptions& options);
/// One line, no control codes.
std::string status_line(const Picture& picture, const ViewOptions& options);
nlohmann::ordered_json to_json(const Picture& picture);
nlohmann::ordered_json to_json(const TopicFlow& flow);

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
