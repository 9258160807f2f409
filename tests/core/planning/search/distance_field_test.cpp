// SPDX-License-Identifier: Apache-2.0
#include "core/planning/search/distance_field.hpp"

#include <gtest/gtest.h>

namespace foretrack {
namespace {

constexpr int kGoal = 200 * kGroundSide + 200;

// A wall along x, two cells below the goal, that ends six cells to the right.
bool may_pass(int cell) {
  const int x = cell % kGroundSide, y = cell / kGroundSide;
  const bool in_square = x > 150 && x < 250 && y > 150 && y < 250;
  return in_square && !(y == 198 && x < 206);
}

TEST(DistanceField, LeadsAroundAWallToItsGoal) {
  DistanceField field;
  FieldQueue queue;
  reserve(field);
  reserve(queue);
  begin_field(field, queue, kGoal);
  int calls = 0;
  while (!field.complete) grow_field(field, queue, 1000, 60000, may_pass), ++calls;
  EXPECT_GE(calls, 9) << "a bounded number of cells at a time";
  const int beyond = kGoal - 4 * kGroundSide;
  EXPECT_EQ(field.steps[beyond], 4 + 2 * 6);
  int cell = beyond;
  for (int i = 0; i < 40 && cell != kGoal; ++i) {
    const int next = downhill(field, cell);
    ASSERT_LT(field.steps[next], field.steps[cell]);
    ASSERT_TRUE(may_pass(next));
    cell = next;
  }
  EXPECT_EQ(cell, kGoal);
  EXPECT_EQ(downhill(field, kGoal), kGoal);
}

TEST(DistanceField, GoesNoFartherThanItIsTold) {
  DistanceField field;
  FieldQueue queue;
  reserve(field);
  reserve(queue);
  begin_field(field, queue, kGoal);
  grow_field(field, queue, 100000, 10, may_pass);
  EXPECT_TRUE(field.complete);
  EXPECT_EQ(field.steps[kGoal + 10], 10);
  EXPECT_EQ(field.steps[kGoal + 11], DistanceField::kNever);
}

}  // namespace
}  // namespace foretrack
