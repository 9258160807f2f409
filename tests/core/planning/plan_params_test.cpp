// SPDX-License-Identifier: Apache-2.0
#include "core/planning/plan_params.hpp"

#include <gtest/gtest.h>

#include "tests/support/param_rows.hpp"

namespace foretrack {
namespace {

TEST(PlanningParams, EveryFieldHasOneRowAndAValidDefault) {
  PlanningParams params;
  EXPECT_EQ(testing::first_hidden_byte(params), -1);
  EXPECT_EQ(testing::repeated_name(rows(params)), "");
  EXPECT_TRUE(faults_of(rows(params)).empty());
}

}  // namespace
}  // namespace foretrack
