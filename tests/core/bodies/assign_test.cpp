// SPDX-License-Identifier: Apache-2.0
#include "core/bodies/assign.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "core/common/random.hpp"

namespace foretrack {
namespace {

constexpr double kForbidden = std::numeric_limits<double>::infinity();

double cost_of(const AssignmentProblem& p, const std::array<int, 16>& column_of) {
  double sum = 0.0;
  for (int i = 0; i < p.rows; ++i) sum += column_of[i] < 0 ? p.leave_cost : p.cost[i][column_of[i]];
  return sum;
}

// Tries everything.
double least_cost(const AssignmentProblem& p, int row, unsigned taken) {
  if (row == p.rows) return 0.0;
  double least = p.leave_cost + least_cost(p, row + 1, taken);
  for (int j = 0; j < p.columns; ++j)
    if (!(taken >> j & 1) && p.cost[row][j] < kForbidden)
      least = std::min(least, p.cost[row][j] + least_cost(p, row + 1, taken | 1U << j));
  return least;
}

TEST(Assign, IsNoWorseThanAnyOtherAssignment) {
  Random random(1);
  for (int trial = 0; trial < 300; ++trial) {
    AssignmentProblem p;
    p.rows = static_cast<int>(random.uniform(0.0, 5.99));
    p.columns = static_cast<int>(random.uniform(0.0, 6.99));
    p.leave_cost = random.uniform(0.0, 2.0);
    for (int i = 0; i < p.rows; ++i)
      for (int j = 0; j < p.columns; ++j)
        p.cost[i][j] = random.chance(0.3) ? kForbidden : random.uniform(-1.0, 2.0);
    const auto column_of = assign(p);
    std::array<int, 8> used{};
    for (int i = 0; i < p.rows; ++i)
      if (column_of[i] >= 0) ++used[column_of[i]];
    EXPECT_LE(*std::max_element(used.begin(), used.end()), 1) << "two rows have one column";
    EXPECT_NEAR(cost_of(p, column_of), least_cost(p, 0, 0), 1e-9) << trial;
  }
}

TEST(Assign, FillsTheLargestProblem) {
  AssignmentProblem p;
  p.rows = AssignmentProblem::kMaxRows;
  p.columns = AssignmentProblem::kMaxColumns;
  p.leave_cost = 10.0;
  for (int i = 0; i < p.rows; ++i)
    for (int j = 0; j < p.columns; ++j) p.cost[i][j] = j == 63 - i ? 0.0 : 1.0;
  const auto column_of = assign(p);
  for (int i = 0; i < p.rows; ++i) EXPECT_EQ(column_of[i], 63 - i);
}

}  // namespace
}  // namespace foretrack
