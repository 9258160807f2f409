// SPDX-License-Identifier: Apache-2.0
// From where, and in which direction, most of the belief is seen soonest.
#pragma once

#include "core/planning/search/person_cloud.hpp"

namespace foretrack {

/// Some of the walkers in the next seconds.
struct CloudFuture {
  static constexpr std::array<double, 7> kMoments_s = {0.3, 1.0, 2.0, 3.0, 4.5, 6.0, 8.0};
  static constexpr int kWalkers = PersonCloud::kWalkers / 4;

  std::array<std::array<Vec2, kMoments_s.size()>, kWalkers> at_m;
  std::array<double, kWalkers> weight;  // sum to 1
};

/// Lets every fourth walker go on. Cost: 0.2 ms.
void foresee(const PersonCloud& cloud, const SearchGround& ground, CloudFuture& future);

/// A place to look from.
struct Viewpoint {
  Vec2 at_m = Vec2::Zero();
  double gaze_rad = 0.0;  // the best direction to look from there
  double worth = -1.0;    // belief that is seen, less the later; 0 to 1
};

/// What it is worth to be at a place from arrival_s on, looking in the best direction for a camera
/// of this angle of view. What would be seen beside that counts a little: the camera can turn.
/// Cost: 20 µs. Who is seen where the vehicle can fly to (`reach`) can be followed, and counts
/// more.
Viewpoint judge_viewpoint(const CloudFuture& future, const SearchGround& ground,
                          const DistanceField& reach, const Vec2& at_m, double arrival_s,
                          double view_angle_rad, const SearchParams& params);

/// True if the person can be within reach_m of the place, in sight of it.
bool may_be_near(const SearchGround& ground, const Vec2& at_m, double reach_m);

}  // namespace foretrack
