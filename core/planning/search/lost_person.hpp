// SPDX-License-Identifier: Apache-2.0
// The search for a person who was lost: a belief over where they can be, and from where to look.
#pragma once

#include "core/common/vehicle.hpp"
#include "core/planning/plan_params.hpp"
#include "core/planning/search/viewpoint.hpp"

namespace foretrack {

/// Belief near the vehicle, gathered in a metre.
struct NearBelief {
  Vec2 at_m = Vec2::Zero();
  Vec2 velocity_m_s = Vec2::Zero();
  double probability = 0.0;
};

/// One for each vehicle, owned by the caller and reused. What may be read is said first.
struct LostPerson {
  bool active = false;   ///< somebody is searched for, or waited for
  bool waits = false;    ///< they are waited for: the vehicle stands
  double since_s = 0.0;  ///< they were seen last
  Vec2 likeliest_m = Vec2::Zero();
  double torso_m = 1.2;   ///< z of their torso
  Viewpoint viewpoint;    ///< that is flown to; worth < 0: none yet
  std::vector<Vec2> way;  ///< to it, from where the vehicle was when it was chosen
  double gaze_rad = 0.0;  ///< where the camera is to look
  double free_m = 0.0;    ///< nobody can be nearer, ahead of the vehicle
  static constexpr int kNear = 6;
  std::array<NearBelief, kNear> near;
  int near_count = 0;  ///< that are valid
  PersonCloud cloud;
  SearchGround ground;

  static constexpr int kGazes = 24;
  std::array<double, kGazes> unseen_s{};  // directions, since the camera looked there
  double ticked_s = 0.0;
  DistanceField reach;  // of the vehicle, flying
  FieldQueue reached;
  double reach_clearance_m = 0.0;  // where it began
  int judged = -1;                 // candidates so far; −1: the vehicle's reach is not known yet
  Viewpoint best;                  // of those
  CloudFuture future;
  DistanceField steps_away;  // of persons, from the vehicle
  FieldQueue steps_queue;
};

/// What one step of the search is given.
struct SearchStep {
  double now_s = 0.0;
  const VehicleState& vehicle;
  const GridMap& map;
  Vec3 from_enu_m = Vec3::Zero();    ///< where the next trajectory begins
  Vec3 velocity_m_s = Vec3::Zero();  ///< and the velocity there
};

/// Takes the memory, so that a search takes none.
void reserve(LostPerson& lost);

/// The person was seen last at the belief's stamp, and is on one of its paths since. Cost: 3 ms.
void begin_search(LostPerson& lost, const TargetBelief& belief, const SearchStep& step,
                  const PlanningParams& params);

/// In this order: walls are read from a new map; the person may have come farther; the walkers go
/// on; the camera has looked and nobody was there; the gaze, and how far it is free ahead. Ten
/// times a second; between, nothing but the ways of the walkers. Cost: 0.5 ms.
void believe(LostPerson& lost, const SearchStep& step, const PlanningParams& params);

/// Goes on with the choice of a place to look from: where the vehicle can fly to, and some places
/// there, judged a few a step. A better one is taken about three times a second. Cost: 0.5 ms.
void choose_viewpoint(LostPerson& lost, const SearchStep& step, const PlanningParams& params);

/// How fast the vehicle may fly: as search_speed_m_s, or faster where nobody can be ahead.
double search_speed_m_s(const LostPerson& lost, const PlanningParams& params);

/// Where the way goes on from a place, a metre ahead; the viewpoint itself where it is nearer.
Vec2 ahead_on_way_m(const LostPerson& lost, const Vec2& from_m);

/// The believed places near the vehicle, as courses that a trajectory must keep clear of.
void add_near_belief(const LostPerson& lost, double now_s, const GapParams& params,
                     BodyCourses& courses);

}  // namespace foretrack
