// SPDX-License-Identifier: Apache-2.0
#include "core/mapping/params.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

#include "core/mapping/update_map.hpp"
#include "tests/support/param_rows.hpp"

namespace foretrack {
namespace testing {

INSTANTIATE_TYPED_TEST_SUITE_P(Mapping, ParamRowsOf, MappingParams);

}  // namespace testing
namespace {

TEST(MappingParams, BadOnesAreRefused) {
  MappingParams params;
  params.resolution_m = 0.0;
  EXPECT_THROW(MappingState state(params), std::invalid_argument);
}

}  // namespace
}  // namespace foretrack
