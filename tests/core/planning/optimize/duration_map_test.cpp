// SPDX-License-Identifier: Apache-2.0
#include "core/planning/optimize/duration_map.hpp"

#include <gtest/gtest.h>

#include <array>

namespace foretrack {
namespace {

TEST(DurationMap, KeepsTheLeastTotalAndInverts) {
  const DurationMap map{3.0};
  const std::array<double, 4> durations{0.5, 1.5, 0.8, 1.2};
  std::array<double, 5> variables;
  std::array<double, 4> back;
  map.to_variables(durations, variables);
  map.to_durations(variables, back);
  for (int i = 0; i < 4; ++i) EXPECT_NEAR(back[i], durations[i], 1e-12);
  for (const double far : {-1e6, -10.0, 0.0, 10.0}) {
    variables = {far, 3.0, -2.0, 0.5, far};
    map.to_durations(variables, back);
    double total = 0.0;
    for (const double t : back) {
      EXPECT_GT(t, 0.0);
      total += t;
    }
    EXPECT_GT(total, 3.0 - 1e-9);
  }
}

TEST(DurationMap, RaisesATotalThatIsTooShort) {
  const DurationMap map{3.0};
  const std::array<double, 2> durations{0.2, 0.4};
  std::array<double, 3> variables;
  std::array<double, 2> back;
  map.to_variables(durations, variables);
  map.to_durations(variables, back);
  EXPECT_GT(back[0] + back[1], 3.0);
  EXPECT_LT(back[0] + back[1], 3.1);
  EXPECT_NEAR(back[1] / back[0], 2.0, 1e-9) << "their shares stay";
}

TEST(DurationMap, PullsGradientsBackAsFiniteDifferencesDo) {
  const DurationMap map{3.0};
  const std::array<double, 3> slopes{2.0, -1.0, 0.5};  // a cost that is linear in the durations
  const auto cost = [&](const std::array<double, 4>& variables) {
    std::array<double, 3> durations;
    map.to_durations(variables, durations);
    return slopes[0] * durations[0] + slopes[1] * durations[1] + slopes[2] * durations[2];
  };
  const std::array<double, 4> at{0.3, -1.2, 2.0, 0.7};
  std::array<double, 4> gradient;
  map.pull_back(at, slopes, gradient);
  for (std::size_t i = 0; i < at.size(); ++i) {
    std::array<double, 4> above = at, below = at;
    above[i] += 1e-6;
    below[i] -= 1e-6;
    EXPECT_NEAR(gradient[i], (cost(above) - cost(below)) / 2e-6, 1e-8) << i;
  }
}

}  // namespace
}  // namespace foretrack
