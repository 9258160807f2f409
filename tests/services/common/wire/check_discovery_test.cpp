// SPDX-License-Identifier: Apache-2.0
#include "services/common/wire/check_discovery.hpp"

#include <gtest/gtest.h>

#include "services/common/wire/check_message.hpp"
#include "tests/services/common/wire/datagram.hpp"

namespace foretrack::testing {
namespace {

using wire::Fault;

Fault fault_of(const Content& parameters) {
  return wire::check_message(announcement(parameters.bytes).bytes).fault;
}
/// With one parameter alone.
Fault fault_of(std::uint16_t id, const Content& value) {
  return fault_of(Content().parameter(id, value.bytes).sentinel());
}

constexpr std::uint16_t kTopicName = 0x05, kPartition = 0x29, kUserData = 0x2c, kFilter = 0x35,
                        kProperties = 0x59, kRepresentation = 0x73, kTypeObject = 0x72,
                        kTypeInformation = 0x75, kToken = 0x1001, kSharing = 0x8006;

TEST(CheckDiscovery, TakesWhatItDoesNotKnowAndRefusesAListWithoutEnd) {
  EXPECT_EQ(fault_of(Content().parameter(0x50, Bytes(16)).parameter(0x7abc, Bytes(5)).sentinel()),
            Fault::kNone);
  EXPECT_EQ(fault_of(Content().parameter(0x50, Bytes(16))), Fault::kDiscovery);
  EXPECT_EQ(fault_of(Content().u16(0x50).u16(60000).zeros(16).sentinel()), Fault::kDiscovery);
}

TEST(CheckDiscovery, RefusesTextWithoutItsEnd) {
  EXPECT_EQ(fault_of(kTopicName, Content().text("rt/uav1/odometry")), Fault::kNone);
  EXPECT_EQ(fault_of(kTopicName, Content().u32(4).append({'a', 'b', 'c', 'd'})), Fault::kDiscovery);
  EXPECT_EQ(fault_of(kTopicName, Content().u32(400).zeros(4)), Fault::kDiscovery);
  EXPECT_EQ(fault_of(kTopicName, Content().u32(0xffffffff).zeros(4)), Fault::kDiscovery);
}

TEST(CheckDiscovery, RefusesCountsOfWhatIsNotThere) {
  EXPECT_EQ(fault_of(kPartition, Content().u32(2).text("a").text("b")), Fault::kNone);
  EXPECT_EQ(fault_of(kPartition, Content().u32(3).text("a").text("b")), Fault::kDiscovery);
  EXPECT_EQ(fault_of(kProperties, Content().u32(1).text("a").text("b")), Fault::kNone);
  EXPECT_EQ(fault_of(kProperties, Content().u32(0xffffffff).text("a").text("b")),
            Fault::kDiscovery);
  EXPECT_EQ(fault_of(kUserData, Content().u32(4).zeros(4)), Fault::kNone);
  EXPECT_EQ(fault_of(kUserData, Content().u32(400).zeros(4)), Fault::kDiscovery);
  EXPECT_EQ(fault_of(kRepresentation, Content().u32(2).zeros(4)), Fault::kNone);
  EXPECT_EQ(fault_of(kRepresentation, Content().u32(0x7fffffff).zeros(4)), Fault::kDiscovery);
  EXPECT_EQ(fault_of(kSharing, Content().u32(1).zeros(8)), Fault::kNone);
  EXPECT_EQ(fault_of(kSharing, Content().u32(0xffff).zeros(8)), Fault::kDiscovery);
}

TEST(CheckDiscovery, ReadsTokensOfSecurity) {
  Content token = Content().text("DDS:Auth:PKI-DH:1.0").u32(1).text("dds.cert.sn").text("CN=x");
  EXPECT_EQ(fault_of(kToken, Content(token).u32(1).text("c").u32(3).zeros(4)), Fault::kNone);
  EXPECT_EQ(fault_of(kToken, Content(token).u32(1).text("c").u32(0xfffffff0).zeros(4)),
            Fault::kDiscovery)
      << "4 GB would be set aside";
  EXPECT_EQ(fault_of(kToken, Content().text("x").u32(0x01000000)), Fault::kDiscovery);
}

TEST(CheckDiscovery, BlanksWhatDescribesTypesAndFilters) {
  Content parameters;
  for (const std::uint16_t id : {kTypeObject, kTypeInformation, kFilter})
    parameters.parameter(id, Bytes(8, 0xff));
  const auto datagram = announcement(parameters.sentinel().bytes);
  const auto checked = wire::check_message(datagram.bytes);
  ASSERT_EQ(checked.fault, Fault::kNone);
  ASSERT_EQ(checked.blank_count, 3u);
  EXPECT_EQ(datagram.bytes[checked.blanks[0]], kTypeObject);
  EXPECT_EQ(datagram.bytes[checked.blanks[1]], kTypeInformation);
  EXPECT_EQ(datagram.bytes[checked.blanks[2]], kFilter);
  Content many;
  for (std::size_t i = 0; i <= wire::Checked::kMostBlanks; ++i)
    many.parameter(kTypeObject, Bytes(4));
  EXPECT_EQ(fault_of(many.sentinel()), Fault::kDiscovery);
}

Fault fault_of_payload(std::uint32_t writer, std::uint32_t reader, const Bytes& payload) {
  Content content = sample(writer, reader);
  content.append(payload);
  const auto datagram = Datagram().submessage(0x15, content.bytes, kLittle | kWithData);
  return wire::check_message(datagram.bytes).fault;
}

TEST(CheckDiscovery, WantsTheEncapsulationOfParameters) {
  const Bytes end = Content().append({0, 3, 0, 0}).sentinel().bytes;
  EXPECT_EQ(fault_of_payload(kParticipantWriter, 0, end), Fault::kNone);
  EXPECT_EQ(fault_of_payload(kParticipantWriter, 0, {0, 2, 0, 0, 0, 1, 0, 0}), Fault::kNone)
      << "big-endian";
  EXPECT_EQ(fault_of_payload(kParticipantWriter, 0, {0, 1, 0, 0, 1, 0, 0, 0}), Fault::kDiscovery);
  EXPECT_EQ(fault_of_payload(kParticipantWriter, 0x000003c7, end), Fault::kNone);
  EXPECT_EQ(fault_of_payload(kParticipantWriter, kUserReader, end), Fault::kDiscovery);
  EXPECT_EQ(fault_of_payload(kUserWriter, kParticipantReader, end), Fault::kDiscovery);
}

TEST(CheckDiscovery, WantsAWholeSignOfLife) {
  const auto sign = [](std::uint32_t length, std::size_t bytes) {
    return fault_of_payload(
        0x000200c2, 0, Content().append({0, 1, 0, 0}).zeros(16).u32(length).zeros(bytes).bytes);
  };
  EXPECT_EQ(sign(0, 0), Fault::kNone);
  EXPECT_EQ(sign(1, 4), Fault::kNone);
  EXPECT_EQ(sign(100, 4), Fault::kDiscovery);
  EXPECT_EQ(fault_of_payload(0x000200c2, 0, {0, 1, 0, 0}), Fault::kDiscovery);
}

TEST(CheckDiscovery, ReadsHandshakes) {
  const auto handshake = [](std::uint32_t count) {
    Content content;
    content.append({0, 1, 0, 0}).zeros(96).text("dds.sec.auth").u32(count);
    content.text("DDS:Auth:PKI-DH:1.0+Req").u32(0).u32(1).text("c.id").u32(5).zeros(8);
    return fault_of_payload(0x000201c3, 0x000201c4, content.bytes);
  };
  EXPECT_EQ(handshake(1), Fault::kNone);
  EXPECT_EQ(handshake(2), Fault::kDiscovery);
  EXPECT_EQ(handshake(0xffffffff), Fault::kDiscovery);
}

}  // namespace
}  // namespace foretrack::testing
