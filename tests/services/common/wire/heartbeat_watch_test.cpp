// SPDX-License-Identifier: Apache-2.0
#include "services/common/wire/heartbeat_watch.hpp"

#include <gtest/gtest.h>

#include "tests/services/common/wire/datagram.hpp"

namespace foretrack::testing {
namespace {

using wire::kLongestLeap;
using wire::kLongestPast;

Bytes heartbeat(std::int64_t first, std::uint32_t writer = kUserWriter) {
  Content content;
  content.big_u32(0).big_u32(writer).sequence_number(first).sequence_number(first).u32(1);
  return Datagram().submessage(0x07, content.bytes).bytes;
}

TEST(HeartbeatWatch, TakesAWriterThatHasWrittenForDaysAndRefusesOneOfCenturies) {
  wire::HeartbeatWatch watch;
  EXPECT_TRUE(watch.accepts(heartbeat(kLongestPast), 0.0));
  EXPECT_FALSE(watch.accepts(heartbeat(std::int64_t{1} << 40, kUserWriter + 1), 0.0))
      << "one message, and the reader steps for years";
}

TEST(HeartbeatWatch, LetsAWriterGoOnAndNotLeap) {
  wire::HeartbeatWatch watch;
  EXPECT_TRUE(watch.accepts(heartbeat(1), 0.0));
  EXPECT_TRUE(watch.accepts(heartbeat(kLongestLeap), 0.1));
  EXPECT_FALSE(watch.accepts(heartbeat(4 * kLongestLeap), 0.2));
  EXPECT_TRUE(watch.accepts(heartbeat(4 * kLongestLeap), 60.0)) << "the link was gone for a minute";
  EXPECT_TRUE(watch.accepts(heartbeat(1), 60.1)) << "an old one does no harm";
  EXPECT_FALSE(watch.accepts(heartbeat(9 * kLongestLeap), 60.2));
}

TEST(HeartbeatWatch, KnowsWritersByTheirSender) {
  wire::HeartbeatWatch watch;
  EXPECT_TRUE(watch.accepts(heartbeat(kLongestPast), 0.0));
  Datagram from_another;
  from_another.submessage(0x0c, Bytes(20, 9));
  const Bytes rest = heartbeat(kLongestPast + 5);
  from_another.bytes.insert(from_another.bytes.end(), rest.begin() + 20, rest.end());
  EXPECT_FALSE(watch.accepts(from_another.bytes, 0.0)) << "unknown, and too far";
  EXPECT_TRUE(watch.accepts(heartbeat(kLongestPast + 5), 0.0));
}

TEST(HeartbeatWatch, LooksAtAllOfAMessage) {
  wire::HeartbeatWatch watch;
  Bytes message = heartbeat(1);
  const Bytes second = heartbeat(std::int64_t{1} << 50, kUserWriter + 1);
  message.insert(message.end(), second.begin() + 20, second.end());
  EXPECT_FALSE(watch.accepts(message, 0.0));
}

}  // namespace
}  // namespace foretrack::testing
