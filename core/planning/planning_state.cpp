// SPDX-License-Identifier: Apache-2.0
#include "core/planning/planning_state.hpp"

namespace foretrack {
namespace {

constexpr std::size_t kPathPoints = 2048;    // of the searched way
constexpr std::size_t kBlockedCells = 8192;  // around one segment
constexpr std::size_t kAngleNodes = 512;
constexpr std::size_t kBodySamples = 1024;
constexpr std::size_t kSteps = 128;  // of the prediction

}  // namespace

void reserve(PlanningState& s) {
  s.ahead.way.points.reserve(kPathPoints);
  s.path_workspace.arc_m.reserve(kPathPoints);
  s.path.vertices.reserve(kMaxPieces);
  s.path.times_s.reserve(kMaxPieces);
  s.corridor.blocked.reserve(kBlockedCells);
  s.corridor.spare.reserve(4 * kMaxPieces);
  s.problem.corridor.reserve(kMaxPieces);
  s.problem.inner_waypoints.reserve(kMaxPieces);
  s.problem.durations_s.reserve(kMaxPieces);
  s.problem.samples.reserve(kMaxIntentions * kSteps);
  s.problem.bodies.reserve(kBodySamples);
  s.aim.yaws_rad.reserve(kAngleNodes);
  s.aim.pitches_rad.reserve(kAngleNodes);
  s.aim.angles.stages.reserve(kAngleNodes);
  for (PlannedTrajectory* trajectory :
       {&s.results[0].trajectory, &s.results[1].trajectory, &s.evading}) {
    trajectory->pieces.reserve(kMaxPieces + 2);  // with a stop before and one after
    trajectory->yaw.nodes.reserve(kAngleNodes);
    trajectory->gimbal_pitch.nodes.reserve(kAngleNodes);
    trajectory->visible_regions.reserve(kSteps);
    trajectory->corridor.reserve(kMaxPieces);
  }
  // All polytopes that a problem and two results can hold.
  std::vector<Polytope> all;
  resize_polytopes(s.corridor, all, 3 * kMaxPieces / kPiecesPerPolytope);
  resize_polytopes(s.corridor, all, 0);
  reserve(s.search);
  s.watched.paths[0].states.reserve(1);
  s.reserved = true;
}

}  // namespace foretrack
