// SPDX-License-Identifier: Apache-2.0
#include "services/common/interfaces.hpp"

#include <gmock/gmock.h>

#include <stdexcept>

namespace foretrack {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

TEST(Interfaces, LoopbackIsThisMachineAlone) {
  for (const char* name : {"lo", "127.0.0.1"}) {
    const auto found = find_interfaces(name);
    EXPECT_THAT(found.addresses, ElementsAre("127.0.0.1"));
    EXPECT_TRUE(found.this_machine_only());
  }
}

TEST(Interfaces, AnyIsAllOfThem) {
  EXPECT_THAT(find_interfaces("any").addresses, IsEmpty());
  EXPECT_FALSE(find_interfaces("any").this_machine_only());
}

TEST(Interfaces, OthersAreUsedBesideTheLoopbackOne) {
  const Interfaces found{{"127.0.0.1", "198.51.100.7"}};
  EXPECT_FALSE(found.this_machine_only());
}

TEST(Interfaces, AnUnknownOneIsNamedWithThoseThereAre) {
  try {
    find_interfaces("wlan77");
    FAIL() << "it was found";
  } catch (const std::invalid_argument& error) {
    EXPECT_THAT(error.what(), HasSubstr("wlan77"));
    EXPECT_THAT(error.what(), HasSubstr("lo (127.0.0.1)"));
  }
}

}  // namespace
}  // namespace foretrack
