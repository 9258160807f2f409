// SPDX-License-Identifier: Apache-2.0
#include "core/safety/latch.hpp"

#include <gtest/gtest.h>

namespace foretrack {
namespace {

TEST(Latch, GoesOnAfterItsTimeAndOffAfterItsOther) {
  Latch latch;
  EXPECT_FALSE(latch.update(true, 0.0, 0.2, 1.0));
  EXPECT_FALSE(latch.update(true, 0.1, 0.2, 1.0));
  EXPECT_TRUE(latch.update(true, 0.2, 0.2, 1.0));
  EXPECT_TRUE(latch.update(false, 0.3, 0.2, 1.0));
  EXPECT_TRUE(latch.update(false, 1.2, 0.2, 1.0));
  EXPECT_FALSE(latch.update(false, 1.4, 0.2, 1.0));
}

TEST(Latch, DoesNotFlickerWithAFaultThatDoes) {
  Latch latch;
  latch.update(true, 0.0, 0.0, 0.3);
  int changes = 0;
  bool before = latch.on;
  for (int i = 1; i < 1000; ++i) {
    const bool on = latch.update(i % 10 == 0, 0.01 * i, 0.0, 0.3);
    changes += on != before;
    before = on;
  }
  EXPECT_TRUE(before);
  EXPECT_EQ(changes, 0);
  Latch slow;
  for (int i = 1; i < 1000; ++i) EXPECT_FALSE(slow.update(i % 10 != 0, 0.01 * i, 0.2, 0.3));
}

}  // namespace
}  // namespace foretrack
