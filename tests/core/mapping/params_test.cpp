// SPDX-License-Identifier: Apache-2.0
#include "core/mapping/params.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

#include "core/mapping/update_map.hpp"
#include "tests/support/param_rows.hpp"

namespace foretrack {
namespace {

TEST(MappingParams, EveryFieldHasOneRowAndAValidDefault) {
  MappingParams params;
  EXPECT_EQ(testing::first_hidden_byte(params), -1);
  EXPECT_EQ(testing::repeated_name(rows(params)), "");
  EXPECT_TRUE(faults_of(rows(params)).empty());
}

TEST(MappingParams, BadOnesAreRefused) {
  MappingParams params;
  params.resolution_m = 0.0;
  EXPECT_THROW(MappingState state(params), std::invalid_argument);
}

}  // namespace
}  // namespace foretrack
