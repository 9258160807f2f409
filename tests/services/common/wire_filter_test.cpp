// SPDX-License-Identifier: Apache-2.0
#include "services/common/wire_filter.hpp"

#include <gmock/gmock.h>

#include "tests/services/common/wire/datagram.hpp"

namespace foretrack::testing {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Pair;
using ::testing::SizeIs;

TEST(WireFilter, CountsByReasonAndReportsNowAndThen) {
  std::vector<std::string> lines;
  WireFilter filter([&](const std::string& line) { lines.push_back(line); });
  EXPECT_EQ(filter.judge(Datagram().bytes).fault, wire::Fault::kNone);
  EXPECT_EQ(filter.accepted(), 1u);
  EXPECT_THAT(filter.refused_by_reason(), IsEmpty());
  for (int i = 0; i < 100; ++i) {
    const auto verdict = filter.judge(Bytes(10));
    EXPECT_THAT(verdict.message, IsEmpty());
    filter.refuse(verdict.fault, "192.0.2.9");
  }
  EXPECT_EQ(filter.refused(), 100u);
  EXPECT_THAT(filter.refused_by_reason(), ElementsAre(Pair("not RTPS 2", 100u)));
  ASSERT_THAT(lines, SizeIs(1)) << "not a line for each";
  EXPECT_THAT(lines[0], HasSubstr("192.0.2.9"));
}

TEST(WireFilter, BlanksInACopyAndLeavesWhatCameAsItIs) {
  WireFilter filter([](const std::string&) {});
  const auto datagram = announcement(Content().parameter(0x72, Bytes(8, 7)).sentinel().bytes);
  const Bytes before = datagram.bytes;
  const auto verdict = filter.judge(datagram.bytes);
  ASSERT_EQ(verdict.message.size(), before.size());
  EXPECT_EQ(datagram.bytes, before);
  std::size_t changed = 0;
  for (std::size_t i = 0; i < before.size(); ++i)
    if (verdict.message[i] != before[i]) {
      ++changed;
      EXPECT_EQ(before[i], 0x72);
      EXPECT_EQ(verdict.message[i], 0);
    }
  EXPECT_EQ(changed, 1u) << "the low byte of the id; the high one was 0";
}

}  // namespace
}  // namespace foretrack::testing
