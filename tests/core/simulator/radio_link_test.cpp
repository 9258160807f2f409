// SPDX-License-Identifier: Apache-2.0
#include "core/simulator/radio_link.hpp"

#include <gtest/gtest.h>

namespace foretrack {
namespace {

TEST(RadioLink, LosesItsShareAndDelaysTheRest) {
  LinkParams link{.loss = 0.3, .delay_s = 0.1, .jitter_s = 0.2, .partitions = {}};
  Random random(5);
  int arrived = 0;
  for (int i = 0; i < 5000; ++i) {
    const auto at_s = arrival_s(link, "a", "b", 10.0, random);
    if (!at_s) continue;
    ++arrived;
    EXPECT_GE(*at_s, 10.1);
    EXPECT_LE(*at_s, 10.3);
  }
  EXPECT_NEAR(arrived, 3500, 150);
}

TEST(RadioLink, InAPartitionOnlyTheirOwnGroupHears) {
  LinkParams link;
  link.partitions.push_back({.from_s = 5.0, .to_s = 15.0, .groups = {{"a"}, {"b", "c"}}});
  EXPECT_TRUE(hears(link, "a", "b", 4.9));
  EXPECT_FALSE(hears(link, "a", "b", 5.0));
  EXPECT_TRUE(hears(link, "c", "b", 10.0));
  EXPECT_FALSE(hears(link, "d", "b", 10.0)) << "in no group";
  EXPECT_TRUE(hears(link, "a", "b", 15.0));
  Random random(1);
  EXPECT_FALSE(arrival_s(link, "a", "b", 6.0, random));
}

TEST(RadioLink, WhatBecomesOfOneMessageChangesNoOther) {
  LinkParams good;
  good.jitter_s = 0.5;
  LinkParams bad = good;
  bad.loss = 1.0;
  Random a(9), b(9);
  arrival_s(good, "a", "b", 0.0, a);
  arrival_s(bad, "a", "b", 0.0, b);
  EXPECT_EQ(arrival_s(good, "a", "b", 0.0, a), arrival_s(good, "a", "b", 0.0, b));
}

TEST(Inbox, DeliversByArrival) {
  Inbox<int> inbox;
  inbox.add(2.0, 1);
  inbox.add(1.0, 2);
  inbox.add(3.0, 3);
  std::vector<int> taken;
  const auto take = [&](int message) { taken.push_back(message); };
  inbox.deliver(0.5, take);
  EXPECT_TRUE(taken.empty());
  inbox.deliver(2.0, take);
  EXPECT_EQ(taken, (std::vector<int>{2, 1}));
  inbox.deliver(9.0, take);
  EXPECT_EQ(taken, (std::vector<int>{2, 1, 3}));
}

}  // namespace
}  // namespace foretrack
