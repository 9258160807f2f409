// SPDX-License-Identifier: Apache-2.0
// Recorded pedestrians: text rows into tracks.
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/simulator/walk.hpp"

namespace foretrack {

/// The columns of a row; positions are in metres.
enum class TrackFormat : std::uint8_t {
  kOpenTraj,  ///< frame id x z y vx vz vy, as the OpenTraj collection has its "obsmat" files
  kFrameIdXy  ///< frame id x y
};

/// Where one pedestrian went.
struct Track {
  int pedestrian = 0;              ///< the id in the file
  std::vector<TrackPoint> points;  ///< times increase; 0 is the first frame of the file
};

/// All tracks of a file's text, by pedestrian. rate_hz: frames a second. Blank lines and what
/// follows # are skipped. Throws std::invalid_argument that names `file_name`, the line, what was
/// found and what was expected.
std::vector<Track> parse_tracks(std::string_view text, TrackFormat format, double rate_hz,
                                const std::string& file_name);

/// The track of one pedestrian. Throws std::invalid_argument that lists those that exist.
const Track& track_of(const std::vector<Track>& tracks, int pedestrian,
                      const std::string& file_name);

/// The least box around the points.
Eigen::AlignedBox2d bounds_of(std::span<const TrackPoint> points);

}  // namespace foretrack
