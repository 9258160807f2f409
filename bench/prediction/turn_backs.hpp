// SPDX-License-Identifier: Apache-2.0
// People who turn round on their way, go back some metres, and then on again.
#pragma once

#include <vector>

#include "core/common/random.hpp"
#include "core/simulator/person.hpp"

namespace foretrack::bench {

/// How somebody comes to walk the other way.
enum class TurnManner {
  kPivot,     // brakes and goes back at once
  kArc,       // walks half a circle
  kStand,     // stops, stands for a while, goes back
  kStepBack,  // stops, goes backwards with the chest as it was, then turns it round
};

struct ReturnRequest {
  double speed_m_s = 1.5;
  double duration_s = 60.0;
  double forth_m = 10.0;         // from one turn back to the next, on average
  bool only_at_the_end = false;  // turns back where the route ends, and nowhere else
};

struct ReturningWalk {
  Walk walk;
  std::vector<BackwardSteps> backward;
};

/// Walks along a route with turns back, in random manners. They are 4 m apart at least: who has
/// just turned back is not about to do so again.
ReturningWalk walk_and_return(const std::vector<Vec2>& route_m, const ReturnRequest& request,
                              Random& random);

}  // namespace foretrack::bench
