// SPDX-License-Identifier: Apache-2.0
#include "services/common/filter_transport.hpp"

#include <arpa/inet.h>
#include <fastdds/rtps/transport/UDPv4TransportDescriptor.h>
#include <fastdds/rtps/transport/shared_mem/SharedMemTransportDescriptor.h>
#include <sys/socket.h>
#include <unistd.h>

#include "foretrack_msgs/msg/TargetState.h"
#include "services/common/reader.hpp"
#include "services/common/topics.hpp"
#include "services/common/writer.hpp"
#include "tests/services/common/bus.hpp"
#include "tests/services/common/wire/datagram.hpp"

namespace foretrack::testing {
namespace {

namespace rtps = eprosima::fastdds::rtps;

constexpr char kTopic[] = "rt/filter/bytes";

/// To all ports that participants of the domain may have on this machine.
void send_to_everybody(const Bytes& message) {
  const int file = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  for (int port = 10; port < 60; ++port) {
    address.sin_port = htons(static_cast<std::uint16_t>(7400 + 250 * domain_id() + port));
    sendto(file, message.data(), message.size(), 0, reinterpret_cast<const sockaddr*>(&address),
           sizeof address);
  }
  close(file);
}

TEST(FilterTransport, ANodeLivesThroughTheMessageThatEndedEveryProcess) {
  Node node(node_options("receiver"));
  Node other(node_options("sender"));
  Bytes message = {'R', 'T', 'P', 'S', 2, 3, 1, 0x0f};
  message.resize(20);
  message.insert(message.end(), {0x80, 1, 0x38, 0});
  message.resize(82);
  send_to_everybody(message);
  ASSERT_TRUE(eventually([&] { return node.wire().refused() > 0 && other.wire().refused() > 0; }));
  EXPECT_TRUE(eventually([&] { return node.last_error().find("127.0.0.1") != std::string::npos; }))
      << node.last_error();
  Reader<topics::TargetState> reader(node);
  Writer<topics::TargetState> writer(other);
  EXPECT_TRUE(eventually([&] { return reader.writers() == 1; })) << "they still meet";
}

TEST(FilterTransport, NothingGoodIsRefusedAmongOurselves) {
  Node node(node_options("receiver"));
  Node other(node_options("sender"));
  Reader<topics::TargetState> reader(node);
  Writer<topics::TargetState> writer(other);
  ASSERT_TRUE(eventually([&] { return reader.writers() == 1; }));
  for (int i = 0; i < 50; ++i) writer.write();
  RawPeer stranger(kTopic, "any::Type_");  // with the library's own transports
  stranger.add_writer();
  EXPECT_TRUE(eventually([&] { return node.endpoints().size() >= 2; }));
  EXPECT_GT(node.wire().accepted(), 0u);
  for (const Node* one : {&node, &other})
    for (const auto& [reason, count] : one->wire().refused_by_reason())
      ADD_FAILURE() << count << " of " << reason;
}

/// Sends bytes from one participant to another, over one transport alone.
void expect_to_carry(const rtps::TransportDescriptorInterface& transport) {
  dds::TransportConfigQos config;
  config.use_builtin_transports = false;
  if (const auto* udp = dynamic_cast<const rtps::UDPv4TransportDescriptor*>(&transport))
    config.user_transports = {std::make_shared<rtps::UDPv4TransportDescriptor>(*udp)};
  if (const auto* shm = dynamic_cast<const rtps::SharedMemTransportDescriptor*>(&transport))
    config.user_transports = {std::make_shared<rtps::SharedMemTransportDescriptor>(*shm)};
  const auto filter = std::make_shared<WireFilter>([](const std::string&) {});
  auto* factory = dds::DomainParticipantFactory::get_instance();
  dds::DomainParticipantQos qos = dds::PARTICIPANT_QOS_DEFAULT;
  qos.transport().use_builtin_transports = false;
  qos.transport().user_transports = filtered_transports(config, {filter, false, {}});
  dds::DomainParticipant* both[2];
  dds::Topic* topics[2];
  for (int i = 0; i < 2; ++i) {
    both[i] = factory->create_participant(domain_id(), qos);
    ASSERT_NE(both[i], nullptr);
    dds::TypeSupport(new RawType("any::Bytes_")).register_type(both[i]);
    topics[i] = both[i]->create_topic(kTopic, "any::Bytes_", dds::TOPIC_QOS_DEFAULT);
  }
  dds::DataWriterQos writer_qos = dds::DATAWRITER_QOS_DEFAULT;
  writer_qos.data_sharing().off();
  auto* writer = both[0]
                     ->create_publisher(dds::PUBLISHER_QOS_DEFAULT)
                     ->create_datawriter(topics[0], writer_qos);
  auto* reader = both[1]
                     ->create_subscriber(dds::SUBSCRIBER_QOS_DEFAULT)
                     ->create_datareader(topics[1], dds::DATAREADER_QOS_DEFAULT);
  ASSERT_TRUE(eventually([&] { return readers_of(writer) == 1; }));
  RawType::Bytes sent(900, 7), heard;
  dds::SampleInfo info;
  EXPECT_TRUE(eventually([&] {
    writer->write(&sent);
    return reader->take_next_sample(&heard, &info) ==
           eprosima::fastrtps::types::ReturnCode_t::RETCODE_OK;
  }));
  EXPECT_EQ(heard, sent);
  EXPECT_GT(filter->accepted(), 0u) << "it went past the filter";
  EXPECT_EQ(filter->refused(), 0u);
  for (auto* one : both) one->delete_contained_entities(), factory->delete_participant(one);
}

TEST(FilterTransport, CarriesUdp) {
  expect_to_carry(rtps::UDPv4TransportDescriptor());
}

TEST(FilterTransport, CarriesSharedMemory) {
  expect_to_carry(rtps::SharedMemTransportDescriptor());
}

TEST(FilterTransport, StandsBeforeWhatTheLibraryAddsByItself) {
  dds::TransportConfigQos config;  // with its own
  const auto filter = std::make_shared<WireFilter>([](const std::string&) {});
  const auto transports = filtered_transports(config, {filter, true, {"127.0.0.1"}});
  ASSERT_EQ(transports.size(), 2u);
  const auto* udp = dynamic_cast<const rtps::UDPv4TransportDescriptor*>(transports[0].get());
  ASSERT_NE(udp, nullptr);
  EXPECT_EQ(udp->interfaceWhiteList, std::vector<std::string>{"127.0.0.1"});
  EXPECT_TRUE(stay_on_this_machine(transports));
  EXPECT_TRUE(names_interfaces(transports));
  const auto open = filtered_transports(config, {filter, false, {}});
  EXPECT_FALSE(stay_on_this_machine(open));
  EXPECT_FALSE(names_interfaces(open));
}

}  // namespace
}  // namespace foretrack::testing
