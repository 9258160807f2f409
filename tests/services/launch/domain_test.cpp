// SPDX-License-Identifier: Apache-2.0
#include "services/launch/domain.hpp"

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <unistd.h>

namespace foretrack {
namespace {

TEST(Domain, TwoFlightsGetDifferentOnes) {
  FreeDomain a, b, c;
  EXPECT_NE(a.id(), b.id());
  EXPECT_NE(a.id(), c.id());
  EXPECT_NE(b.id(), c.id());
}

TEST(Domain, IsInUseWhileSomebodyListensOnItsPorts) {
  const FreeDomain domain;
  ASSERT_FALSE(domain_is_in_use(domain.id()));
  const int file = socket(AF_INET, SOCK_DGRAM, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<std::uint16_t>(7400 + 250 * domain.id() + 10));
  ASSERT_EQ(bind(file, reinterpret_cast<sockaddr*>(&address), sizeof address), 0);
  EXPECT_TRUE(domain_is_in_use(domain.id()));
  close(file);
}

}  // namespace
}  // namespace foretrack
