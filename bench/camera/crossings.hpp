// SPDX-License-Identifier: Apache-2.0
// Others who come near the person who is followed: is it still the same person afterwards?
#pragma once

#include "bench/camera/walks.hpp"

namespace foretrack {

/// How the other one comes near. The camera follows the person from behind or from the side.
enum class Crossing : std::uint8_t {
  kInFront,  // between the camera and the person, across
  kBehind,   // the person hides the other one for a moment
  kBeside,   // walks along at an arm's length
  kAgainst,  // comes towards the person and passes at an arm's length
  kStands,   // stands where the person passes, near the line of sight
};
inline constexpr std::array<std::string_view, 5> kCrossingNames = {"in front", "behind", "beside",
                                                                   "against", "stands"};

struct CrossingScores {
  int encounters = 0;
  int switches = 0;     // the track is fed, and the other one's, for half a second or at the end
  int said = 0;         // switches of which health spoke: not longer before than a second
  int astray = 0;       // the same if the track only coasts there, or is fed
  int lost_at_end = 0;  // no track in the last half second
  int frames = 0, found = 0;  // found: a pose, of anybody
  int refused = 0;            // poses that the filter refused
  int of_other = 0;           // poses that it took, but are the other one's
  int ambiguous = 0;          // images of which it was said
  int near_frames = 0;        // the other one is close in the image
  double network_ms = 0.0;    // CPU, sum

  void add(const CrossingScores& other);
};

/// Who is beside is drawn from the walk's seed.
void run_crossing(const WalkCase& walk, Crossing crossing, PoseNetwork& network,
                  const PerceptionParams& params, CrossingScores& scores);

}  // namespace foretrack
