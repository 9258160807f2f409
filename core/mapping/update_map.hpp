// SPDX-License-Identifier: Apache-2.0
// Depth images → the map around the vehicle.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "core/common/camera.hpp"
#include "core/common/grid_map.hpp"
#include "core/common/vehicle.hpp"
#include "core/mapping/find_movers.hpp"
#include "core/mapping/params.hpp"

namespace octomap {
class OcTree;
}

namespace foretrack {

/// What became of a depth image.
enum class MapStatus : std::uint8_t {
  kUpdated,        ///< it is in the map
  kNoVehiclePose,  ///< the vehicle's history does not reach the image's stamp; nothing changed
  kInvalidImage,   ///< its size is not that of its camera; nothing changed
};
/// For logs and displays.
std::string_view to_string(MapStatus status);

/// The map that is being built. It has two parts:
///
/// - A dense box around the vehicle that scrolls with it. It holds the log-odds of each cell.
/// - An octree of everything that was ever seen. It holds the class of each cell: occupied or free.
///   The box is filled from it where the box comes to lie anew.
///
/// Cells of the box and leaves of the octree coincide. Source: Hornung et al. 2013 (OctoMap); the
/// box is ours.
struct MappingState {
  /// Throws std::invalid_argument on bad parameters.
  explicit MappingState(const MappingParams& params);
  MappingState(MappingState&&) noexcept;
  MappingState& operator=(MappingState&&) noexcept;
  ~MappingState();

  GridMap map;                            ///< the box, with classes and distances
  std::vector<std::int8_t> log_odds;      ///< of the box's cells, in steps of 0.05; −128: unknown
  std::vector<float> free_s;              ///< when a ray last found the cell free, after first_s
  double first_s = 0.0;                   ///< stamp of the first image
  std::unique_ptr<octomap::OcTree> tree;  ///< all that was seen
  Eigen::Vector3i base;                   ///< octree index of the box's cell (0, 0, 0)
  bool placed = false;                    ///< the box has its first place
  BodySightings movers;                   ///< what moves, in the newest image

  std::vector<std::uint8_t> marks;     ///< workspace of one update
  std::vector<std::uint32_t> touched;  ///< workspace of one update
  std::vector<std::int8_t> shifted;    ///< workspace of one update
  std::vector<float> shifted_free_s;   ///< workspace of one update
  MoverColumns mover_columns;          ///< workspace of one update
  DistanceWorkspace distances;         ///< workspace of one update
};

/// What one depth image did to the map.
struct MapUpdate {
  MapStatus status = MapStatus::kUpdated;
  bool scrolled = false;  ///< the box moved with the vehicle
  int hits = 0;           ///< returns in the box and within range, without those of moving bodies
  int rays = 0;           ///< rays that were cast
  int touched_cells = 0;  ///< cells that were hit or passed
  int changed_cells = 0;  ///< cells that became occupied or free
};

/// Takes one depth image into the map: moves the box with the vehicle, casts the image's rays into
/// it from the vehicle's pose at the image's stamp (Amanatides and Woo 1987), and renews the
/// distances. A cell that is both hit and passed in one image is hit.
///
/// Returns from moving bodies (the followed person, other people, what else moves) are no
/// obstacles, but the way to them is seen to be free. A body is a cylinder where it is expected at
/// the image's stamp, a margin wider. What stands in the open, where it is free or was until lately
/// all around, is in state.movers afterwards; the followed person is not.
///
/// Unknown cells right around the vehicle and before its camera become free: it is there, and a
/// camera does not see them.
///
/// Cost: about 5 ms for 640 × 480 pixels with the defaults. Only the octree allocates after
/// warm-up.
MapUpdate update_map(MappingState& state, const DepthImage& image, const VehicleHistory& vehicle,
                     std::span<const MovingBody> bodies, const MappingParams& params);

/// Those of the bodies that count for an image of this time: all, or none where they are stale.
std::span<const MovingBody> bodies_at(double stamp_s, const MovingBodies& bodies,
                                      const MappingParams& params);

/// The box around the vehicle. It is empty before the first update.
const GridMap& local_map(const MappingState& state);

}  // namespace foretrack
