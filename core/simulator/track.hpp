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
  kOpenTraj,   ///< frame id x z y vx vz vy, as the OpenTraj collection has its "obsmat" files
  kFrameIdXy,  ///< frame id x y, unless the file names its columns (# id frame x y z)
  kIdFrameXy   ///< id frame x y, as PedPy has them
};

/// Where one pedestrian went.
struct Track {
  int pedestrian = 0;              ///< the id in the file
  std::vector<TrackPoint> points;  ///< times increase; 0 is the first frame of the file
  std::vector<int> lines;          ///< of the file, one a point
};

/// Nobody runs faster.
inline constexpr double kFastestPerson_m_s = 8.0;

/// All tracks of a file's text, by pedestrian. rate_hz: frames a second; 0: what the file says
/// (# framerate: 25), else 25. Blank lines, a byte-order mark and what follows # are skipped, but
/// for names of columns. Throws std::invalid_argument that names `file_name`, the line, what was
/// found and what was expected; also if most of what is read is faster than anybody, with what may
/// be the reason: other columns, another rate, pixels.
std::vector<Track> parse_tracks(std::string_view text, TrackFormat format, double rate_hz,
                                const std::string& file_name);

/// The track of one pedestrian. Throws std::invalid_argument that lists those that exist, or names
/// the line to which this one jumps, faster than anybody.
const Track& track_of(const std::vector<Track>& tracks, int pedestrian,
                      const std::string& file_name);

/// The least box around the points.
Eigen::AlignedBox2d bounds_of(std::span<const TrackPoint> points);

}  // namespace foretrack
