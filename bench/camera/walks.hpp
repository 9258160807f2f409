// SPDX-License-Identifier: Apache-2.0
// Rendered people who walk before the camera, and what the pose network makes of them.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/perception/perceive_image.hpp"
#include "core/tracker/tracker.hpp"

namespace foretrack {

/// One walk: a camera that keeps its distance while the person turns every way.
struct WalkCase {
  std::uint64_t seed = 1;
  std::string person = "boy";
  double height_m = 1.75;
  double distance_m = 3.0;
  double seconds = 8.0;
};

/// Of each measured position and yaw, and of the filter's estimate at the image.
struct PoseErrors {
  std::vector<double> horizontal_m, horizontal_filtered_m;
  std::vector<double> range_m;  // along the line of sight, signed
  std::vector<double> yaw_rad, yaw_filtered_rad;
};

/// Of all frames of all walks.
struct WalkScores {
  int in_view = 0, detected = 0;        // whole person before the camera, nothing between
  int partly = 0, detected_partly = 0;  // the torso and the head at least, but not all
  PoseErrors by_height, by_depth;       // range from the known height; corrected by a depth image
  int hidden = 0, false_poses = 0;      // nothing of the person in sight
  int appearances = 0;
  std::vector<double> found_again_s;         // from an appearance to the first pose
  double network_ms = 0.0, render_ms = 0.0;  // CPU, sums
  int frames = 0;

  void add(const WalkScores& other);
};

/// Turns at all yaws, nothing between.
void run_walk(const WalkCase& walk, PoseNetwork& network, const PerceptionParams& params,
              WalkScores& scores);

/// To and fro behind a wall, before a camera that stands still.
void run_hidden_walk(const WalkCase& walk, PoseNetwork& network, const PerceptionParams& params,
                     WalkScores& scores);

}  // namespace foretrack
