// SPDX-License-Identifier: Apache-2.0
#include "services/common/rendezvous.hpp"

#include <gmock/gmock.h>

#include <cstdlib>

#include "tests/support/error_of.hpp"

namespace foretrack {
namespace {

using ::testing::HasSubstr;

TEST(MeetingPoint, IsAHostAndPerhapsAPort) {
  EXPECT_EQ(find_meeting_point("192.0.2.7").address, "192.0.2.7");
  EXPECT_EQ(find_meeting_point("192.0.2.7").port, 0);
  EXPECT_EQ(find_meeting_point("localhost:11811").address, "127.0.0.1");
  EXPECT_EQ(find_meeting_point("localhost:11811").port, 11811);
  for (const char* wrong : {"192.0.2.7:", "192.0.2.7:0", "192.0.2.7:65536", "192.0.2.7:7x", ":7"})
    EXPECT_NE(error_of([&] { return find_meeting_point(wrong); }), "no error") << wrong;
}

TEST(MeetingPoint, IsReachedByTheAddressThatLeadsThere) {
  EXPECT_EQ(address_towards({.address = "127.0.0.1"}), "127.0.0.1");
}

TEST(DiscoveryRange, IsThatOfRos2) {
  const auto range_of = [](const char* text) {
    setenv("ROS_AUTOMATIC_DISCOVERY_RANGE", text, 1);
    return discovery_range();
  };
  EXPECT_EQ(range_of("OFF"), DiscoveryRange::kNobody);
  EXPECT_EQ(range_of("LOCALHOST"), DiscoveryRange::kThisMachine);
  EXPECT_EQ(range_of("SUBNET"), DiscoveryRange::kSubnet);
  EXPECT_EQ(range_of("SYSTEM_DEFAULT"), DiscoveryRange::kDefault);
  EXPECT_THAT(error_of([&] { return range_of("subnet"); }), HasSubstr("is 'subnet'"));
  unsetenv("ROS_AUTOMATIC_DISCOVERY_RANGE");
  EXPECT_EQ(discovery_range(), DiscoveryRange::kDefault);
}

}  // namespace
}  // namespace foretrack
