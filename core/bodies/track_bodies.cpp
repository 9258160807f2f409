// SPDX-License-Identifier: Apache-2.0
#include "core/bodies/track_bodies.hpp"

#include <algorithm>
#include <limits>

#include "core/bodies/assign.hpp"

namespace foretrack {
namespace {

constexpr double kNotSeen_s = 0.2;    // of two bodies in one place, the one that is not seen goes
constexpr double kBirthLearnt = 0.1;  // of where something stands that does not move
constexpr double kRestart_s = 1.0;    // time that goes back: a simulation was started anew
constexpr double kNever = std::numeric_limits<double>::infinity();

double cost_of(const BodyTrack& track, const BodySighting& seen, double stamp_s,
               const BodyParams& params) {
  const Match m = match(track, seen, stamp_s);
  const bool within = m.mahalanobis2 <= params.gate_mahalanobis * params.gate_mahalanobis;
  return within ? m.cost() : kNever;
}

// Columns: the tracks, and behind them the followed person.
AssignmentProblem problem_of(const BodiesState& state, const BodySightings& seen,
                             const BodyTrack* followed, const BodyParams& params) {
  AssignmentProblem problem;
  problem.rows = seen.count;
  problem.columns = state.count + (followed ? 1 : 0);
  // Whoever is within the gate is preferred to a new body.
  problem.leave_cost = 100.0;
  for (int i = 0; i < seen.count; ++i) {
    for (int j = 0; j < state.count; ++j)
      problem.cost[i][j] = cost_of(state.tracks[j], seen.bodies[i], seen.stamp_s, params);
    if (followed)
      problem.cost[i][state.count] = cost_of(*followed, seen.bodies[i], seen.stamp_s, params);
  }
  return problem;
}

double apart_m(const BodyTrack& a, const BodyTrack& b) {
  return (a.position_m() - b.position_m()).norm();
}

void believe(BodiesState& state, BodyTrack& track, const BodyParams& params) {
  if (track.id != 0) return;
  track.born_m += kBirthLearnt * (track.position_m() - track.born_m);
  if (track.hits < params.birth_hits) return;
  const bool moved = (track.position_m() - track.born_m).norm() >= params.birth_way_m;
  if (track.kind != BodyKind::kUnknown || moved) track.id = ++state.last_id;
}

void begin(BodiesState& state, const BodySighting& seen, const PersonLook* look,
           const BodyTrack* followed, double stamp_s, const BodyParams& params) {
  BodyTrack track = begin_track(seen, stamp_s, params);
  if (followed && apart_m(track, *followed) < 2.0 * params.followed_radius_m) return;
  if (state.count == BodiesState::kCapacity) return;
  if (look) track.look = *look;
  believe(state, track, params);
  state.tracks[state.count++] = track;
}

// One of two in the same place goes: the one that is not believed, is not seen, or is younger.
bool is_double(const BodiesState& state, int k, const BodyTrack* followed,
               const BodyParams& params) {
  const BodyTrack& track = state.tracks[k];
  const bool unseen = state.newest_s - track.seen_s > kNotSeen_s;
  if (followed && unseen && apart_m(track, *followed) < 2.0 * params.followed_radius_m) return true;
  for (int j = 0; j < state.count; ++j) {
    const BodyTrack& other = state.tracks[j];
    if (j == k || apart_m(track, other) >= params.same_place_m) continue;
    if (track.id == 0 && other.id != 0) return true;
    if (track.id != 0 && other.id == 0) continue;
    const bool other_unseen = state.newest_s - other.seen_s > kNotSeen_s;
    if (unseen != other_unseen ? unseen : j < k) return true;
  }
  return false;
}

template <class Predicate>
void remove_tracks(BodiesState& state, Predicate&& over) {
  for (int k = state.count - 1; k >= 0; --k) {
    if (!over(k)) continue;
    std::move(state.tracks.begin() + k + 1, state.tracks.begin() + state.count,
              state.tracks.begin() + k);
    --state.count;
  }
}

}  // namespace

int track_bodies(BodiesState& state, const BodySightings& seen, const TargetState& target,
                 const BodyParams& params, std::span<const PersonLook> looks) {
  if (seen.stamp_s < state.newest_s - kRestart_s) state = {};
  if (seen.stamp_s < state.newest_s - params.late_s) return -1;
  state.newest_s = std::max(state.newest_s, seen.stamp_s);
  BodyTrack person;
  const BodyTrack* followed = nullptr;
  if (target.usable()) {
    person = track_of(target);
    predict_track(person, state.newest_s, params);
    followed = &person;
  }
  for (int k = 0; k < state.count; ++k) predict_track(state.tracks[k], state.newest_s, params);

  int of_followed = -1;
  const int tracked = state.count;
  const auto track_of_row = assign(problem_of(state, seen, followed, params));
  for (int i = 0; i < seen.count; ++i) {
    const PersonLook* look = looks.empty() ? nullptr : &looks[i];
    const int k = track_of_row[i];
    if (k < 0) begin(state, seen.bodies[i], look, followed, seen.stamp_s, params);
    if (k == tracked) of_followed = i;
    if (k < 0 || k == tracked) continue;
    BodyTrack& track = state.tracks[k];
    correct_track(track, seen.bodies[i], seen.stamp_s);
    if (look && look->known()) take_look(track, *look);
    believe(state, track, params);
  }
  remove_tracks(state, [&](int k) { return is_over(state.tracks[k], state.newest_s, params); });
  remove_tracks(state, [&](int k) { return is_double(state, k, followed, params); });
  return of_followed;
}

}  // namespace foretrack
