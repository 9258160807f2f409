// SPDX-License-Identifier: Apache-2.0
#include "services/offline/experiments/identity.hpp"

#include <gtest/gtest.h>

#include "services/offline/people/load_person.hpp"

namespace foretrack {
namespace {

TEST(Identity, TheSameSeedTellsTheSameAndNobodyIsTakenForAnother) {
  if (!std::filesystem::exists(kPeopleFile))
    GTEST_SKIP() << "the people's models are not installed";
  IdentityRequest request;
  request.events = 12;
  const auto cells = bench_identity(request);
  EXPECT_EQ(table_of(bench_identity(request)), table_of(cells));
  int events = 0;
  for (const IdentityCell& cell : cells) {
    events += cell.events;
    EXPECT_EQ(cell.wrong, 0) << kIdentityEventNames[static_cast<std::size_t>(cell.kind)];
  }
  EXPECT_EQ(events, 12);
}

TEST(Identity, EndsWhenItIsToldTo) {
  if (!std::filesystem::exists(kPeopleFile))
    GTEST_SKIP() << "the people's models are not installed";
  IdentityRequest request;
  request.goes_on = [](int done) { return done < 2; };
  int events = 0;
  for (const IdentityCell& cell : bench_identity(request)) events += cell.events;
  EXPECT_EQ(events, 2);
}

}  // namespace
}  // namespace foretrack
