// SPDX-License-Identifier: Apache-2.0
// Where a person who was lost is believed to be: walkers who go on as the person might.
#pragma once

#include <array>

#include "core/common/random.hpp"
#include "core/planning/search/distance_field.hpp"
#include "core/planning/search/search_params.hpp"
#include "core/planning/see/target_belief.hpp"

namespace foretrack {

/// One of the places where the person may be, and what they would do there.
struct Walker {
  Vec2 at_m = Vec2::Zero();
  Vec2 heading = Vec2::UnitX();  // unit
  double speed_m_s = 1.2;
  double stands_s = 0.0;  // for so long
  double weight = 0.0;    // all sum to 1
  int errand = -1;        // that they are on; −1: straight on
  int errand_number = 0;
};

/// A place to which somebody may be walking, with the way there from everywhere.
struct Errand {
  DistanceField way;
  int number = 0;  // grows when the errand is given anew
};

/// People walk to somewhere, around what stands there, mostly on in the direction in which they
/// were walking; there some of them stand for a while, and go elsewhere. So they leave a room
/// through its doors, and do not wander about in it. The same calls give the same walkers.
struct PersonCloud {
  static constexpr int kWalkers = 384;
  static constexpr int kErrands = 12;

  std::array<Walker, kWalkers> walkers;
  std::array<Errand, kErrands> errands;
  FieldQueue queue;
  std::array<std::int32_t, 64> open_cells{};  // some to which the vehicle can fly
  int open_count = 0;
  int making = 0;          // of the errands
  double speed_m_s = 1.2;  // of the person
  double evidence = 1.0;   // small: they should have been seen, wherever a walker is
  Random random{1};
};

/// Takes the memory.
void reserve(PersonCloud& cloud);

/// Walkers on the believed paths, as likely as the paths are, where they are expected now; none
/// behind a wall.
void begin_cloud(PersonCloud& cloud, const SearchGround& ground, const TargetBelief& belief,
                 double now_s, const SearchParams& params);

/// Goes on with the ways of the errands; old errands are given anew. Half of them lead to where the
/// vehicle can fly to: who comes back there can be found. Cost: 0.3 ms.
void plan_errands(PersonCloud& cloud, const SearchGround& ground);

/// One walker goes on. `random` is drawn from.
void walk_on(Walker& walker, const PersonCloud& cloud, const SearchGround& ground, double dt_s,
             Random& random);

/// All of them. Cost: 50 µs.
void walk_on(PersonCloud& cloud, const SearchGround& ground, double dt_s);

/// Nobody was seen in this look: walkers in sight weigh less, and those who weigh next to nothing
/// are replaced by others. If nobody is left, the walkers begin anew wherever the person can be.
/// Cost: 40 µs.
void look_in_vain(PersonCloud& cloud, const SearchGround& ground, const Vec2& from_m,
                  double yaw_rad, double half_angle_rad, const SearchParams& params);

/// The place of a metre that holds most of the belief.
Vec2 likeliest_place_m(const PersonCloud& cloud);

}  // namespace foretrack
