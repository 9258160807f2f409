// SPDX-License-Identifier: Apache-2.0
#include "services/convert/visual.hpp"

#include "convert_test_support.hpp"
#include "core/prediction/intentions/intention_table.hpp"

namespace foretrack {
namespace {

using visualization_msgs::msg::MarkerArray;

PlannedTrajectory straight_plan() {
  PlannedTrajectory plan;
  plan.start_s = 1.0;
  QuinticPiece piece;
  piece.duration_s = 0.95;
  piece.coefficients.row(1) = Vec3(1.0, 0.0, 0.0).transpose();
  plan.pieces.push_back(piece);
  return plan;
}

TEST(Path, OfAPlanEndsWhereThePlanEnds) {
  nav_msgs::msg::Path path;
  to_path(straight_plan(), path);
  ASSERT_EQ(path.poses().size(), 11u);
  EXPECT_NEAR(path.poses().back().pose().position().x(), 0.95, 1e-12);
  EXPECT_NEAR(seconds(path.poses().back().header().stamp()), 1.95, 1e-9);
}

TEST(Path, OfNothingIsEmpty) {
  nav_msgs::msg::Path path;
  to_path(straight_plan(), path);
  to_path(PlannedTrajectory{}, path);
  EXPECT_TRUE(path.poses().empty());
  to_path(Prediction{}, path);
  EXPECT_TRUE(path.poses().empty());
}

TEST(Markers, PathsFadeWithTheirProbability) {
  Prediction prediction;
  prediction.paths = {{Intention::kForward, 0.8, {PredictedState{}}},
                      {Intention::kTurnLeft, 0.2, {PredictedState{}}}};
  MarkerArray markers;
  to_markers(IntentionAssessment{}, prediction, markers);
  ASSERT_EQ(markers.markers().size(), 2u);
  EXPECT_GT(markers.markers()[0].color().a(), markers.markers()[1].color().a());
  EXPECT_NE(markers.markers()[0].id(), markers.markers()[1].id());
}

TEST(Markers, ABoxHasTwelveEdges) {
  PlannedTrajectory plan;
  plan.corridor.push_back(Polytope{
      {{1, 0, 0, 1}, {-1, 0, 0, 1}, {0, 1, 0, 2}, {0, -1, 0, 2}, {0, 0, 1, 3}, {0, 0, -1, 3}}});
  MarkerArray markers;
  to_markers(plan, markers);
  ASSERT_EQ(markers.markers().size(), 1u);
  const auto& points = markers.markers()[0].points();
  ASSERT_EQ(points.size(), 24u);
  for (const auto& p : points) {
    EXPECT_NEAR(std::abs(p.x()), 1.0, 1e-9);
    EXPECT_NEAR(std::abs(p.y()), 2.0, 1e-9);
    EXPECT_NEAR(std::abs(p.z()), 3.0, 1e-9);
  }
}

TEST(Markers, ATargetThatWasNeverSeenIsNotDrawn) {
  MarkerArray markers;
  to_markers(TargetState{}, markers);
  EXPECT_TRUE(markers.markers().empty());
}

}  // namespace
}  // namespace foretrack
