// SPDX-License-Identifier: Apache-2.0
// Sightings → bodies that keep their number: others who walk by, and what else moves.
#pragma once

#include <span>

#include "core/bodies/body_track.hpp"
#include "core/common/target.hpp"

namespace foretrack {

/// All tracks, those that are not believed yet among them. A plain value that the caller owns.
struct BodiesState {
  static constexpr int kCapacity = 32;

  double newest_s = -1e9;  ///< stamp of the newest frame
  std::uint32_t last_id = 0;
  std::uint32_t followed_id = 0;  ///< of the person who is followed; 0: never seen
  PersonLook followed_look;
  int count = 0;
  std::array<BodyTrack, kCapacity> tracks;

  std::span<const BodyTrack> all() const {
    return {tracks.data(), static_cast<std::size_t>(count)};
  }
};

/// One frame of one detector: predict, assign globally (nearest neighbours by likelihood, gated),
/// correct, begin and end tracks. Frames of several detectors may come in any order within late_s.
/// A sighting of the followed person (`target`) is told from others and dropped. A person is
/// believed after birth_hits sightings; something that moves, when it has gone birth_way_m besides.
/// `looks`: of the sightings one by one, or empty. Returns the index of the sighting of the
/// followed person, or −1. Cost: about 0.1 ms for 16 sightings; allocates nothing.
int track_bodies(BodiesState& state, const BodySightings& seen, const TargetState& target,
                 const BodyParams& params, std::span<const PersonLook> looks = {});

}  // namespace foretrack
