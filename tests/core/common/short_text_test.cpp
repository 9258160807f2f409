// SPDX-License-Identifier: Apache-2.0
#include "core/common/short_text.hpp"

#include <gtest/gtest.h>

namespace foretrack {
namespace {

TEST(ShortText, KeepsWhatFitsAndCutsTheRest) {
  EXPECT_TRUE(ShortText().empty());
  EXPECT_EQ(ShortText("ada").view(), "ada");
  EXPECT_EQ(ShortText(std::string(100, 'x')).view(), std::string(64, 'x'));
  EXPECT_EQ(ShortText("ada"), ShortText(std::string_view("ada")));
  EXPECT_NE(ShortText("ada"), ShortText("bob"));
  EXPECT_NE(ShortText("ada"), ShortText("ad"));
}

}  // namespace
}  // namespace foretrack
