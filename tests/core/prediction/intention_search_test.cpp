// SPDX-License-Identifier: Apache-2.0
#include "core/prediction/intention_search.hpp"

#include <gtest/gtest.h>

#include "core/common/random.hpp"
#include "tests/core/prediction/worlds.hpp"

namespace foretrack {
namespace {

using namespace foretrack::testing;

SearchRequest request_from(const Vec2& position_m, const Vec2& velocity_m_s, Intention root) {
  return {
      .start = {position_m, velocity_m_s}, .height_m = 1.2, .recent_turn_rad = 0.0, .root = root};
}

struct Found {
  SearchOutcome outcome;
  std::vector<SearchNode> path;
};

Found search(const SearchRequest& request, const GridMap& map,
             const PredictionParams& params = {}) {
  SearchWorkspace w;
  Found found{search_path(request, map, params, w), {}};
  for (const auto i : w.path) found.path.push_back(w.nodes[i]);
  return found;
}

double exact_clearance_m(const std::vector<Box>& boxes, const Vec2& p) {
  double nearest = 1e9;
  for (const Box& b : boxes) {
    const double dx = std::max({b.x_min_m - p.x(), 0.0, p.x() - b.x_max_m});
    const double dy = std::max({b.y_min_m - p.y(), 0.0, p.y() - b.y_max_m});
    nearest = std::min(nearest, std::hypot(dx, dy));
  }
  return nearest;
}

TEST(IntentionSearch, FollowsTheIntentionItselfInTheOpen) {
  const GridMap map = open_field();
  const PredictionParams params;
  for (const IntentionRow& row : kIntentions) {
    const auto found = search(request_from({0, 0}, {1.5, 0}, row.id), map);
    ASSERT_EQ(found.outcome.status, SearchStatus::kFound);
    ASSERT_EQ(static_cast<int>(found.path.size()), params.step_count());
    PlanarState x{{0, 0}, {1.5, 0}};
    double turned = 0.0;
    for (const SearchNode& n : found.path) {
      const MotionModel model = row.motion_model(params);
      const bool turns = model.kind == MotionModel::Kind::kCoordinatedTurn;
      const double half_step = 0.5 * std::abs(model.rate) * params.step_s;
      const bool done = turns && turned + half_step > params.max_turn_rad;
      x = advance(done ? MotionModel::constant_velocity() : model, x, params.step_s);
      if (turns && !done) turned += std::abs(model.rate) * params.step_s;
      EXPECT_NEAR((n.state.position_m - x.position_m).norm(), 0.0, 1e-9);
    }
  }
}

TEST(IntentionSearch, WaitsBesideTheWallAndTurnsAtTheFirstRoom) {
  const auto found =
      search(request_from({-2.0, 0.4}, {1.5, 0}, Intention::kTurnLeft), left_corner());
  ASSERT_EQ(found.outcome.status, SearchStatus::kFound);
  // Straight on until the wall on the left (x < 0) ends, then around it.
  for (const SearchNode& n : found.path)
    EXPECT_TRUE(n.state.position_m.x() > -0.5 || n.intention == Intention::kForward);
  EXPECT_GT(found.path.back().state.velocity_m_s.y(), 1.2);
  EXPECT_GT(found.path.back().state.position_m.y(), 1.5);
}

TEST(IntentionSearch, TurnsOnceAndNotFurtherThanTheLimit) {
  const PredictionParams params;
  const auto found = search(request_from({0, 0}, {1.0, 0}, Intention::kTurnRight), open_field());
  ASSERT_EQ(found.outcome.status, SearchStatus::kFound);
  EXPECT_NEAR(found.path.back().turned_rad, -params.max_turn_rad,
              0.5 * params.turn_rate_rad_s * 0.2);
}

TEST(IntentionSearch, CountsATurnThatHasBegun) {
  auto request = request_from({0, 0}, {1.0, 0}, Intention::kTurnLeft);
  request.recent_turn_rad = rad(50.0);
  const auto found = search(request, open_field());
  ASSERT_EQ(found.outcome.status, SearchStatus::kFound);
  const PredictionParams params;
  EXPECT_NEAR(found.path.back().turned_rad, params.max_turn_rad - rad(50.0),
              0.5 * params.turn_rate_rad_s * params.step_s);
}

TEST(IntentionSearch, FindsNoTurnInANarrowCorridor) {
  for (const Intention root : {Intention::kTurnLeft, Intention::kTurnRight}) {
    const auto found = search(request_from({-2, 0}, {1.5, 0}, root), narrow_corridor());
    EXPECT_EQ(found.outcome.status, SearchStatus::kImpossible);
  }
}

TEST(IntentionSearch, GoesForwardAroundABendOrStopsInADeadEnd) {
  const auto bend = search(request_from({-1, 0}, {1.5, 0}, Intention::kForward), left_corner());
  ASSERT_EQ(bend.outcome.status, SearchStatus::kFound);
  EXPECT_LT(bend.path.back().state.position_m.x(), 1.75);
  const GridMap dead_end = map_of({{-8, 8, 0.8, 8}, {-8, 8, -8, -0.8}, {1, 8, -8, 8}});
  const auto stop = search(request_from({-1, 0}, {1.5, 0}, Intention::kForward), dead_end);
  ASSERT_EQ(stop.outcome.status, SearchStatus::kFound);
  EXPECT_LT(stop.path.back().state.velocity_m_s.norm(), 0.8);
  EXPECT_LT(stop.path.back().state.position_m.x(), 0.75);
}

TEST(IntentionSearch, KeepsWholeArcsClearOfWalls) {
  // Random boxes and starts; every arc of every path, sampled finely against the exact boxes.
  Random random(3);
  const PredictionParams params;
  int paths = 0;
  for (int world = 0; world < 12; ++world) {
    std::vector<Box> boxes;
    for (int i = 0; i < 14; ++i) {
      const double x = random.uniform(-6, 6), y = random.uniform(-6, 6);
      boxes.push_back({x, x + random.uniform(0.2, 1.5), y, y + random.uniform(0.2, 1.5)});
    }
    const GridMap map = map_of(boxes);
    for (int start = 0; start < 6; ++start) {
      const Vec2 p(random.uniform(-5, 5), random.uniform(-5, 5));
      if (exact_clearance_m(boxes, p) < params.target_radius_m + 0.15) continue;
      for (const IntentionRow& row : kIntentions) {
        const Vec2 v = random.uniform(0.5, 2.0) * direction_of(random.uniform(-kPi, kPi));
        const auto found = search(request_from(p, v, row.id), map);
        if (found.outcome.status != SearchStatus::kFound) continue;
        ++paths;
        PlanarState x{p, v};
        for (const SearchNode& n : found.path) {
          const MotionModel model = row_of(n.intention).motion_model(params);
          for (double t = 0.0; t <= params.step_s; t += 0.01)
            // A cell is occupied by its centre here, so a box may be a cell's half-diagonal off.
            ASSERT_GT(exact_clearance_m(boxes, advance(model, x, t).position_m),
                      params.target_radius_m - 0.15);
          x = n.state;
        }
      }
    }
  }
  EXPECT_GT(paths, 100);
}

TEST(IntentionSearch, DoesNotJumpOverAThinWall) {
  const GridMap map = map_of({{0.5, 0.6, -8, 8}});
  const PlanarState fast{{0, 0}, {8.0, 0}};
  EXPECT_FALSE(arc_is_free(map, 1.2, MotionModel::constant_velocity(), fast, 0.2, 0.3));
  EXPECT_TRUE(
      arc_is_free(map, 1.2, MotionModel::constant_velocity(), {{1.5, 0}, {8, 0}}, 0.2, 0.3));
}

TEST(IntentionSearch, LetsAStartTooNearAWallGoOnButNotDeeper) {
  // The wall's face is at y = 1; the target seems to be 0.15 m from it.
  const GridMap map = map_of({{-8, 8, 1, 8}});
  const auto along = search(request_from({-4, 0.85}, {1.5, 0}, Intention::kForward), map);
  ASSERT_EQ(along.outcome.status, SearchStatus::kFound);
  EXPECT_NEAR(along.path.back().state.position_m.x(), 0.5, 1e-6);
  const auto into = search(request_from({-4, 0.85}, {1.0, 0.6}, Intention::kForward), map);
  for (const SearchNode& n : into.path) EXPECT_LT(n.state.position_m.y(), 0.96);
}

TEST(IntentionSearch, StopsAtItsBoundAndSaysSo) {
  PredictionParams params;
  params.max_expansions = 5;
  const auto found =
      search(request_from({0, 0}, {1.5, 0}, Intention::kForward), open_field(), params);
  EXPECT_EQ(found.outcome.status, SearchStatus::kExhausted);
  EXPECT_EQ(found.outcome.expansions, 5);
  EXPECT_TRUE(found.path.empty());
}

}  // namespace
}  // namespace foretrack
