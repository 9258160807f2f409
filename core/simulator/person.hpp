// The person who is followed: walks, stops suddenly, turns the shoulders before the path turns.
#pragma once

#include <array>
#include <vector>

#include "core/common/target.hpp"
#include "core/simulator/walk.hpp"

namespace foretrack {

/// The person stops at at_s and stands for for_s. A stop that falls into a corner begins after it.
struct StandStill {
  double at_s = 0.0;
  double for_s = 1.0;
};

struct PersonParams {
  double height_m = 1.75;
  double acceleration_m_s2 = 3.0;  // of stops and starts
  double shoulder_lead_s = 0.3;    // the chest points where the walk will be heading then
  double yaw_rate_rad_s = 5.0;     // greatest of the chest
  double start_s = 1.5;            // stands before setting off
  std::vector<StandStill> stops;
};

/// Truth. The position is that of the torso's centre.
struct PersonState {
  double stamp_s = 0.0;
  Vec3 position_enu_m = Vec3::Zero();
  Vec3 velocity_enu_m_s = Vec3::Zero();
  Vec3 acceleration_enu_m_s2 = Vec3::Zero();
  double body_yaw_rad = 0.0;
  double stride_rad = 0.0;  // phase of the legs
};

struct Person {
  PersonParams params;
  Walk walk;
  PersonState state;
  double walked_s = 0.0;  // along the walk
  double pace = 1.0;      // d walked_s / dt: below 1 while stopping and standing
};

/// A person at the start of the walk. ground_z_m: where the feet are.
Person make_person(const PersonParams& params, Walk walk, double ground_z_m);

/// Moves on to state.stamp_s + dt_s. Cost: logarithmic in the walk's pieces.
void advance(Person& person, double dt_s);

/// The 33 joints in the world, left and right as the person's own; legs and arms swing with the
/// stride. The mean of joints 11, 12, 23 and 24 is position_enu_m.
std::array<Vec3, kLandmarkCount> joints_enu_m(const PersonState& state, double height_m);

/// Height of the torso's centre above the feet.
double torso_height_m(double height_m);

/// Points that decide whether the person is in sight: head, both shoulders, hip, knee.
std::array<Vec3, 5> body_points_enu_m(const PersonState& state, double height_m);

}  // namespace foretrack
