// SPDX-License-Identifier: Apache-2.0
#include "core/bodies/assign.hpp"

#include <algorithm>
#include <limits>

namespace foretrack {
namespace {

constexpr int kMost = AssignmentProblem::kMaxColumns + AssignmentProblem::kMaxRows + 1;
constexpr double kForbidden = 1e12;

// Rows and columns count from 1; column 0 is where the row that is being placed starts. Columns
// beyond the problem's are for rows that stay without one.
struct Solver {
  const AssignmentProblem& problem;
  int columns;
  std::array<double, AssignmentProblem::kMaxRows + 1> row_price{};
  std::array<double, kMost> column_price{};
  std::array<int, kMost> row_of{};  // of a column; 0: none

  double reduced_cost(int row, int column) const {
    const double cost = column > problem.columns
                            ? problem.leave_cost
                            : std::min(problem.cost[row - 1][column - 1], kForbidden);
    return cost - row_price[row] - column_price[column];
  }

  // Places one more row along the shortest path of changes (Dijkstra on reduced costs).
  void place(int row) {
    std::array<double, kMost> least;
    std::array<int, kMost> from{};
    std::array<bool, kMost> done{};
    least.fill(std::numeric_limits<double>::infinity());
    row_of[0] = row;
    int at = 0;
    while (row_of[at] != 0) {
      done[at] = true;
      const int next = step(row_of[at], at, least, from, done);
      const double by = least[next];
      for (int j = 0; j <= columns; ++j)
        if (done[j])
          row_price[row_of[j]] += by, column_price[j] -= by;
        else
          least[j] -= by;
      at = next;
    }
    for (; at != 0; at = from[at]) row_of[at] = row_of[from[at]];
  }

  int step(int row, int at, std::array<double, kMost>& least, std::array<int, kMost>& from,
           const std::array<bool, kMost>& done) const {
    int next = -1;
    for (int j = 1; j <= columns; ++j) {
      if (done[j]) continue;
      const double cost = reduced_cost(row, j);
      if (cost < least[j]) least[j] = cost, from[j] = at;
      if (next < 0 || least[j] < least[next]) next = j;
    }
    return next;
  }
};

}  // namespace

std::array<int, AssignmentProblem::kMaxRows> assign(const AssignmentProblem& problem) {
  Solver solver{.problem = problem, .columns = problem.columns + problem.rows};
  for (int row = 1; row <= problem.rows; ++row) solver.place(row);
  std::array<int, AssignmentProblem::kMaxRows> column_of;
  column_of.fill(-1);
  for (int j = 1; j <= problem.columns; ++j) {
    const int row = solver.row_of[j] - 1;
    if (row >= 0 && problem.cost[row][j - 1] < kForbidden) column_of[row] = j - 1;
  }
  return column_of;
}

}  // namespace foretrack
