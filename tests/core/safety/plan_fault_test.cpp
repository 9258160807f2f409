// SPDX-License-Identifier: Apache-2.0
#include "core/safety/plan_fault.hpp"

#include <gtest/gtest.h>

#include <set>

namespace foretrack {
namespace {

TEST(PlanFault, EachIsSaidInWordsOfItsOwnAndNoneInNone) {
  EXPECT_EQ(to_string(PlanFault::kNone), "");
  std::set<std::string_view> words;
  for (int i = 0; i < kPlanFaultCount; ++i) words.insert(to_string(static_cast<PlanFault>(i)));
  EXPECT_EQ(words.size(), static_cast<std::size_t>(kPlanFaultCount));
  EXPECT_EQ(to_string(PlanFault::kBounds), "outside of what may be flown in");
}

}  // namespace
}  // namespace foretrack
