// SPDX-License-Identifier: Apache-2.0
#include "services/common/wire/check_message.hpp"

#include <gtest/gtest.h>

#include "tests/services/common/wire/datagram.hpp"

namespace foretrack::testing {
namespace {

using wire::Fault;

Fault fault_of(const Datagram& datagram) {
  return wire::check_message(datagram.bytes).fault;
}
Fault fault_of(std::uint8_t id, const Content& content, std::uint8_t flags = kLittle) {
  return fault_of(Datagram().submessage(id, content.bytes, flags));
}

constexpr std::uint8_t kAckNack = 0x06, kHeartbeat = 0x07, kGap = 0x08, kInfoTime = 0x09,
                       kInfoSource = 0x0c, kInfoDestination = 0x0e, kNackFrag = 0x12,
                       kHeartbeatFrag = 0x13, kData = 0x15, kDataFrag = 0x16, kBody = 0x30,
                       kPrefix = 0x31, kPostfix = 0x32, kWholePrefix = 0x33, kWholePostfix = 0x34,
                       kStatistics = 0x80;

TEST(CheckMessage, TakesAHeaderAloneAndNothingShorterOrOther) {
  EXPECT_EQ(fault_of(Datagram()), Fault::kNone);
  Datagram cut;
  cut.bytes.pop_back();
  EXPECT_EQ(fault_of(cut), Fault::kHeader);
  EXPECT_EQ(fault_of(Datagram(0x0f, 1)), Fault::kHeader);
  Datagram other;
  other.bytes[3] = 'X';
  EXPECT_EQ(fault_of(other), Fault::kHeader);
  EXPECT_EQ(wire::check_message({}).fault, Fault::kHeader);
}

TEST(CheckMessage, RefusesASubmessageThatIsLongerThanTheMessage) {
  EXPECT_EQ(fault_of(Datagram().header(0x42, 1, 4)), Fault::kFrame);
  Datagram cut;
  cut.bytes.insert(cut.bytes.end(), {0x42, 1, 0});
  EXPECT_EQ(fault_of(cut), Fault::kFrame);
  EXPECT_EQ(fault_of(Datagram().submessage(0x42, Bytes(4))), Fault::kNone)
      << "an id of later versions is nobody's fault";
  EXPECT_EQ(fault_of(Datagram().submessage(0x00, Bytes(4))), Fault::kFrame);
}

TEST(CheckMessage, ReadsBothByteOrders) {
  Datagram big;
  big.bytes.insert(big.bytes.end(), {0x42, 0, 0, 4, 1, 2, 3, 4});
  EXPECT_EQ(fault_of(big), Fault::kNone);
  Datagram little;
  little.bytes.insert(little.bytes.end(), {0x42, 1, 0, 4, 1, 2, 3, 4});
  EXPECT_EQ(fault_of(little), Fault::kFrame);
}

TEST(CheckMessage, CutsStatisticsAtTheEndAndRefusesThemElsewhere) {
  Datagram fine;
  const std::size_t before = fine.bytes.size();
  fine.submessage(kStatistics, Bytes(56));
  const auto checked = wire::check_message(fine.bytes);
  EXPECT_EQ(checked.fault, Fault::kNone);
  EXPECT_EQ(checked.size, before);

  Datagram early;
  early.submessage(kStatistics, Bytes(56)).bytes.insert(early.bytes.end(), {0, 0});
  EXPECT_NE(fault_of(early), Fault::kNone) << "these 82 bytes ended every process";
  EXPECT_EQ(fault_of(Datagram().submessage(kStatistics, Bytes(56)).submessage(0x01, Bytes(4))),
            Fault::kStatistics);
  EXPECT_EQ(fault_of(Datagram().submessage(kStatistics, Bytes(52))), Fault::kStatistics);
  const auto of_another_vendor = Datagram(0x10).submessage(kStatistics, Bytes(52));
  EXPECT_EQ(fault_of(of_another_vendor), Fault::kNone);
}

TEST(CheckMessage, RefusesHeartbeatsThatCountBackwardsOrTooFar) {
  const auto heartbeat = [](std::int64_t first, std::int64_t last) {
    return fault_of(kHeartbeat,
                    Content().zeros(8).sequence_number(first).sequence_number(last).u32(1));
  };
  EXPECT_EQ(heartbeat(1, 0), Fault::kNone) << "nothing is kept";
  EXPECT_EQ(heartbeat(3, 9), Fault::kNone);
  EXPECT_EQ(heartbeat(3, 1), Fault::kSequence);
  EXPECT_EQ(heartbeat(-1, 1), Fault::kSequence);
  EXPECT_EQ(heartbeat(1, INT64_MAX), Fault::kSequence);
  EXPECT_EQ(fault_of(kHeartbeat, Content().zeros(20)), Fault::kSequence);
}

TEST(CheckMessage, RefusesBitmapsThatAreLongerThanTheirSubmessage) {
  const auto answer = [](std::uint32_t bits, std::size_t words) {
    return fault_of(kAckNack,
                    Content().zeros(8).sequence_number(1).u32(bits).zeros(4 * words).u32(1));
  };
  EXPECT_EQ(answer(0, 0), Fault::kNone);
  EXPECT_EQ(answer(33, 2), Fault::kNone);
  EXPECT_EQ(answer(256, 8), Fault::kNone);
  EXPECT_EQ(answer(257, 9), Fault::kSequence);
  EXPECT_EQ(answer(128, 2), Fault::kSequence);
  const auto fragments = [](std::int64_t number, std::uint32_t first, std::uint32_t bits) {
    return fault_of(kNackFrag,
                    Content().zeros(8).sequence_number(number).u32(first).u32(bits).zeros(8));
  };
  EXPECT_EQ(fragments(1, 1, 32), Fault::kNone);
  EXPECT_EQ(fragments(0, 1, 32), Fault::kSequence);
  EXPECT_EQ(fragments(1, 0, 32), Fault::kSequence);
  EXPECT_EQ(fragments(1, 1, 255), Fault::kSequence);
}

TEST(CheckMessage, RefusesGapsThatWouldBeWalkedForHours) {
  const auto gap = [](std::int64_t first, std::int64_t base) {
    return fault_of(kGap, Content().zeros(8).sequence_number(first).sequence_number(base).u32(0));
  };
  EXPECT_EQ(gap(1, 1000), Fault::kNone);
  EXPECT_EQ(gap(1, std::int64_t{1} << 40), Fault::kSequence);
  EXPECT_EQ(gap(0, 5), Fault::kSequence);
  EXPECT_EQ(gap(5, 4), Fault::kSequence);
}

TEST(CheckMessage, RefusesInfoThatIsTooShort) {
  EXPECT_EQ(fault_of(kInfoDestination, Content().zeros(12)), Fault::kNone);
  EXPECT_EQ(fault_of(kInfoDestination, Content().zeros(8)), Fault::kFrame);
  EXPECT_EQ(fault_of(kInfoSource, Content().zeros(20)), Fault::kNone);
  EXPECT_EQ(fault_of(kInfoSource, Content().zeros(16)), Fault::kFrame);
  EXPECT_EQ(fault_of(kInfoTime, Content().zeros(8)), Fault::kNone);
  EXPECT_EQ(fault_of(kInfoTime, Content().zeros(4)), Fault::kFrame);
  EXPECT_EQ(fault_of(kInfoTime, Content(), kLittle | 2), Fault::kNone) << "no time";
  EXPECT_EQ(fault_of(kHeartbeatFrag, Content().zeros(8).sequence_number(1).zeros(8)), Fault::kNone);
  EXPECT_EQ(fault_of(kHeartbeatFrag, Content().zeros(12)), Fault::kSequence);
}

TEST(CheckMessage, TakesSamplesAndRefusesThoseWhoseHeaderIsWrong) {
  constexpr std::uint8_t kFlags = kLittle | kWithData;
  EXPECT_EQ(fault_of(kData, sample().zeros(8), kFlags), Fault::kNone);
  EXPECT_EQ(fault_of(kData, sample().zeros(3), kFlags), Fault::kData) << "no encapsulation";
  EXPECT_EQ(fault_of(kData, sample(), kLittle), Fault::kNone) << "disposed of";
  EXPECT_EQ(fault_of(kData, sample().zeros(8), kFlags | kWithKey), Fault::kData);
  EXPECT_EQ(fault_of(kData, sample(kUserWriter, 0, 0).zeros(8), kFlags), Fault::kData);
  EXPECT_EQ(fault_of(kData, sample(kUserWriter, 0, -5).zeros(8), kFlags), Fault::kData);
  for (const std::uint16_t to_inline : {0, 12, 18, 400, 0x8010, 0xffff})
    EXPECT_EQ(fault_of(kData, sample(kUserWriter, 0, 1, to_inline).zeros(8), kFlags), Fault::kData)
        << to_inline;
  EXPECT_EQ(fault_of(kData, sample(kUserWriter, 0, 1, 20).zeros(8), kFlags), Fault::kNone)
      << "a later version";
}

TEST(CheckMessage, RefusesInlineParametersThatDoNotEnd) {
  constexpr std::uint8_t kFlags = kLittle | kWithData | kInline;
  EXPECT_EQ(fault_of(kData, sample().parameter(0x70, Bytes(16)).sentinel().zeros(8), kFlags),
            Fault::kNone);
  EXPECT_EQ(fault_of(kData, sample().parameter(0x70, Bytes(16)).zeros(2), kFlags), Fault::kData);
  EXPECT_EQ(fault_of(kData, sample().u16(0x70).u16(600).zeros(16), kFlags), Fault::kData);
  EXPECT_EQ(fault_of(kData, sample().sentinel(), kFlags), Fault::kData) << "no payload";
}

struct Piece {
  std::uint32_t first = 1, count = 1, size = 1024, all = 4096;
  std::size_t bytes = 1024;
  std::uint32_t writer = kUserWriter;
  std::uint8_t flags = kLittle;
};

Fault fault_of(const Piece& piece) {
  Content content = sample(piece.writer, 0, 1, 28);
  content.u32(piece.first).u16(piece.count).u16(piece.size).u32(piece.all).zeros(piece.bytes);
  return fault_of(kDataFrag, content, piece.flags);
}

TEST(CheckMessage, TakesFragmentsAndRefusesThoseThatCannotBeOfTheirSample) {
  EXPECT_EQ(fault_of(Piece{}), Fault::kNone);
  EXPECT_EQ(fault_of(Piece{.first = 4, .all = 3500, .bytes = 428}), Fault::kNone) << "the last one";
  EXPECT_EQ(fault_of(Piece{.count = 3, .bytes = 3072}), Fault::kNone);
  EXPECT_EQ(fault_of(Piece{.first = 0}), Fault::kFragment);
  EXPECT_EQ(fault_of(Piece{.first = 5}), Fault::kFragment);
  EXPECT_EQ(fault_of(Piece{.first = 0xffffffff}), Fault::kFragment);
  EXPECT_EQ(fault_of(Piece{.count = 0}), Fault::kFragment);
  EXPECT_EQ(fault_of(Piece{.count = 2}), Fault::kFragment) << "fewer bytes than it says";
  EXPECT_EQ(fault_of(Piece{.size = 0}), Fault::kFragment);
  EXPECT_EQ(fault_of(Piece{.size = 4}), Fault::kFragment);
  EXPECT_EQ(fault_of(Piece{.all = 0}), Fault::kFragment);
  EXPECT_EQ(fault_of(Piece{.all = 0xffffffff}), Fault::kFragment) << "memory for all of it";
  EXPECT_EQ(fault_of(Piece{.all = 2049}), Fault::kFragment) << "the library's list would not fit";
  EXPECT_EQ(fault_of(Piece{.bytes = 0}), Fault::kFragment);
  EXPECT_EQ(fault_of(Piece{.flags = kLittle | 4}), Fault::kFragment) << "a key in pieces";
  EXPECT_EQ(fault_of(Piece{.writer = kParticipantWriter}), Fault::kDiscovery);
}

Content prefix() {
  return Content().zeros(20);
}
Content body(std::uint32_t length, std::size_t bytes) {
  return Content().big_u32(length).zeros(bytes);
}
Content postfix(std::uint32_t receivers = 0) {
  return Content().zeros(16).big_u32(receivers).zeros(20 * receivers);
}

TEST(CheckMessage, LetsProtectedSubmessagesPass) {
  EXPECT_EQ(fault_of(Datagram()
                         .submessage(kPrefix, prefix().bytes)
                         .submessage(kBody, body(30, 32).bytes)
                         .submessage(kPostfix, postfix(2).bytes)),
            Fault::kNone);
  EXPECT_EQ(fault_of(Datagram()
                         .submessage(kPrefix, prefix().bytes)
                         .submessage(kInfoDestination, Bytes(12))
                         .submessage(kPostfix, postfix().bytes)),
            Fault::kNone)
      << "signed";
  EXPECT_EQ(fault_of(Datagram()
                         .submessage(kWholePrefix, prefix().bytes)
                         .submessage(kBody, body(32, 32).bytes)
                         .submessage(kWholePostfix, postfix(1).bytes)
                         .submessage(kStatistics, Bytes(56))),
            Fault::kNone);
  EXPECT_EQ(fault_of(Datagram()
                         .submessage(kWholePrefix, prefix().bytes)
                         .submessage(kInfoSource, Bytes(20))
                         .submessage(kInfoDestination, Bytes(12))
                         .submessage(kWholePostfix, postfix(1).bytes)),
            Fault::kNone)
      << "signed";
}

TEST(CheckMessage, RefusesCipherTextThatWouldBeReadBeyondItsEnd) {
  const auto with = [](const Content& inner) {
    return fault_of(Datagram()
                        .submessage(kPrefix, prefix().bytes)
                        .submessage(kBody, inner.bytes)
                        .submessage(kPostfix, postfix().bytes));
  };
  EXPECT_EQ(with(body(32, 32)), Fault::kNone);
  EXPECT_EQ(with(body(60000, 32)), Fault::kSecurity);
  EXPECT_EQ(with(body(0xffffffff, 32)), Fault::kSecurity);
  EXPECT_EQ(with(body(8, 32)), Fault::kSecurity);
  EXPECT_EQ(with(Content().zeros(2)), Fault::kSecurity);
}

TEST(CheckMessage, RefusesPartsOfProtectionThatStandAlone) {
  EXPECT_EQ(fault_of(Datagram().submessage(kPrefix, prefix().bytes)), Fault::kSecurity);
  EXPECT_EQ(fault_of(Datagram().submessage(kBody, body(32, 32).bytes)), Fault::kSecurity);
  EXPECT_EQ(fault_of(Datagram().submessage(kPostfix, postfix().bytes)), Fault::kSecurity);
  EXPECT_EQ(fault_of(Datagram().submessage(kWholePrefix, prefix().bytes)), Fault::kSecurity);
  EXPECT_EQ(fault_of(Datagram()
                         .submessage(kPrefix, prefix().bytes)
                         .submessage(kBody, body(32, 32).bytes)
                         .submessage(kInfoDestination, Bytes(12))),
            Fault::kSecurity);
  EXPECT_EQ(fault_of(Datagram()
                         .submessage(kWholePrefix, prefix().bytes)
                         .submessage(kWholePostfix, postfix().bytes)
                         .submessage(kInfoDestination, Bytes(12))),
            Fault::kSecurity);
  EXPECT_EQ(fault_of(Datagram().submessage(kPrefix, Bytes(16)).submessage(kPostfix, Bytes(20))),
            Fault::kSecurity);
  Content codes = Content().zeros(16).big_u32(500).zeros(20);
  EXPECT_EQ(fault_of(Datagram()
                         .submessage(kPrefix, prefix().bytes)
                         .submessage(kBody, body(32, 32).bytes)
                         .submessage(kPostfix, codes.bytes)),
            Fault::kSecurity);
}

TEST(CheckMessage, HasAWordForEveryFault) {
  for (std::size_t i = 0; i < wire::kFaults; ++i)
    EXPECT_GT(std::string(wire::word(static_cast<Fault>(i))).size(), 4u) << i;
}

}  // namespace
}  // namespace foretrack::testing
