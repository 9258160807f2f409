// SPDX-License-Identifier: Apache-2.0
// The assignment problem: who is who, all together.
#pragma once

#include <array>

namespace foretrack {

/// rows × columns costs; an infinite one forbids the pair.
struct AssignmentProblem {
  static constexpr int kMaxRows = 16, kMaxColumns = 64;

  int rows = 0;
  int columns = 0;
  double leave_cost = 0.0;  ///< of a row without a column
  std::array<std::array<double, kMaxColumns>, kMaxRows> cost{};
};

/// For each row its column, or −1: the assignment of the least sum, each column at most once
/// (successive shortest paths with potentials; Kuhn 1955, Jonker and Volgenant 1987). Cost:
/// rows² · (columns + rows).
std::array<int, AssignmentProblem::kMaxRows> assign(const AssignmentProblem& problem);

}  // namespace foretrack
