// SPDX-License-Identifier: Apache-2.0
#include "tests/fuzz/bus/peer.hpp"

#include <fastdds/rtps/transport/ChainingTransport.h>
#include <fastdds/rtps/transport/UDPv4TransportDescriptor.h>

#include <chrono>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <stdexcept>
#include <thread>

#include "foretrack_msgs/msg/LocalMap.h"
#include "foretrack_msgs/msg/MissionCommand.h"
#include "foretrack_msgs/msg/SafetyState.h"
#include "foretrack_msgs/msg/TargetState.h"
#include "foxglove_msgs/msg/CompressedVideo.h"
#include "nav_msgs/msg/Odometry.h"
#include "octomap_msgs/msg/Octomap.h"
#include "sensor_msgs/msg/Image.h"
#include "services/common/cdr_type.hpp"
#include "services/common/dds_impl.hpp"
#include "services/common/filter_transport.hpp"
#include "services/common/loop.hpp"
#include "services/common/participant.hpp"
#include "services/common/reader.hpp"
#include "services/common/topics.hpp"
#include "services/common/writer.hpp"
#include "tf2_msgs/msg/TFMessage.h"

namespace foretrack::testing {
namespace {

namespace rtps = eprosima::fastdds::rtps;
using eprosima::fastrtps::rtps::Locator_t;

struct CapturingDescriptor : rtps::ChainingTransportDescriptor {
  CapturingDescriptor(std::shared_ptr<rtps::TransportDescriptorInterface> below,
                      std::shared_ptr<Seeds> kept)
      : ChainingTransportDescriptor(std::move(below)), seeds(std::move(kept)) {}
  rtps::TransportInterface* create_transport() const override;
  std::shared_ptr<Seeds> seeds;
};

class CapturingTransport : public rtps::ChainingTransport {
 public:
  explicit CapturingTransport(const CapturingDescriptor& descriptor)
      : ChainingTransport(descriptor), seeds_(descriptor.seeds) {}
  rtps::TransportDescriptorInterface* get_configuration() override {
    return low_level_transport_->get_configuration();
  }
  void shutdown() override { low_level_transport_->shutdown(); }
  bool send(eprosima::fastrtps::rtps::SenderResource* below, const std::uint8_t* bytes,
            std::uint32_t size, eprosima::fastrtps::rtps::LocatorsIterator* begin,
            eprosima::fastrtps::rtps::LocatorsIterator* end,
            const std::chrono::steady_clock::time_point& timeout) override {
    seeds_->add(bytes, size);
    return below->send(bytes, size, begin, end, timeout);
  }
  void receive(rtps::TransportReceiverInterface* above, const std::uint8_t* bytes,
               std::uint32_t size, const Locator_t& local, const Locator_t& remote) override {
    const auto checked = wire::check_message({bytes, size});
    if (checked.fault == wire::Fault::kNone)
      above->OnDataReceived(bytes, static_cast<std::uint32_t>(checked.size), local, remote);
  }

 private:
  std::shared_ptr<Seeds> seeds_;
};

rtps::TransportInterface* CapturingDescriptor::create_transport() const {
  return new CapturingTransport(*this);
}

dds::DomainParticipantQos open_qos(const std::string& name, const std::string& identity) {
  NodeOptions options;
  options.service = name;
  options.security = identity;
  const auto filter = std::make_shared<WireFilter>([](const std::string&) {});
  auto qos = set_up_participant(options, filter).qos;
  const auto udp = std::make_shared<rtps::UDPv4TransportDescriptor>();
  udp->interfaceWhiteList = {"127.0.0.1"};
  qos.transport().user_transports = {udp};
  return qos;
}

// One of each profile, large samples among them; the image is cut into fragments.
using ToVictim = std::tuple<topics::TargetState, topics::MissionCommand, topics::LocalMap,
                            topics::DepthImage, topics::StaticTransforms, topics::Odometry>;
using FromVictim = std::tuple<topics::SafetyState, topics::OctoMap, topics::Transforms>;

std::string wire_name(const TopicInfo& info) {
  return topic_name(info, Names{});
}

template <class Sample>
void fill(Sample&) {}
void fill(topics::DepthImage::Type& image) {
  image.encoding("16UC1");
  image.data().resize(200000);
}
void fill(topics::LocalMap::Type& map) {
  map.header().frame_id("world");
}

}  // namespace

struct Peer::Dds {
  dds::DomainParticipant* participant = nullptr;
  dds::Publisher* publisher = nullptr;
  dds::Subscriber* subscriber = nullptr;
  std::vector<std::function<void()>> writers;
  std::vector<std::function<int()>> readers;

  [[noreturn]] void be_the_open_victim(int domain, const std::string& identity);
  template <class Topic>
  dds::Topic* topic() {
    const auto ops = type_ops<typename Topic::Type>();
    dds::TypeSupport type(new CdrType(ops));
    type.register_type(participant);
    return participant->create_topic(wire_name(Topic::info), ops.name, dds::TOPIC_QOS_DEFAULT);
  }
  template <class Topic>
  void add_writer() {
    dds::DataWriterQos qos;
    publisher->get_datawriter_qos_from_profile(Topic::info.profile, qos);
    auto* writer = publisher->create_datawriter(topic<Topic>(), qos);
    const auto sample = std::make_shared<typename Topic::Type>();
    fill(*sample);
    if (writer) writers.push_back([writer, sample] { writer->write(sample.get()); });
  }
  template <class Topic>
  void add_reader() {
    dds::DataReaderQos qos;
    subscriber->get_datareader_qos_from_profile(Topic::info.profile, qos);
    auto* reader = subscriber->create_datareader(topic<Topic>(), qos);
    if (!reader) return;
    readers.push_back([reader] {
      typename Topic::Type sample;
      dds::SampleInfo info;
      int count = 0;
      while (reader->take_next_sample(&sample, &info) == ReturnCode_t::RETCODE_OK) ++count;
      return count;
    });
  }
};

Peer::Peer(int domain, std::shared_ptr<Seeds> seeds, const std::string& identity)
    : dds_(std::make_unique<Dds>()) {
  auto qos = open_qos("peer", identity);
  auto& transports = qos.transport().user_transports;
  transports.front() = std::make_shared<CapturingDescriptor>(transports.front(), std::move(seeds));
  dds_->participant =
      dds::DomainParticipantFactory::get_instance()->create_participant(domain, qos);
  if (!dds_->participant) throw std::runtime_error("the peer cannot join");
  dds_->publisher = dds_->participant->create_publisher(dds::PUBLISHER_QOS_DEFAULT);
  dds_->subscriber = dds_->participant->create_subscriber(dds::SUBSCRIBER_QOS_DEFAULT);
  std::apply([this](auto... topic) { (dds_->add_writer<decltype(topic)>(), ...); }, ToVictim{});
  std::apply([this](auto... topic) { (dds_->add_reader<decltype(topic)>(), ...); }, FromVictim{});
}

Peer::~Peer() {
  dds_->participant->delete_contained_entities();
  dds::DomainParticipantFactory::get_instance()->delete_participant(dds_->participant);
}

void Peer::write() {
  for (const auto& write : dds_->writers) write();
}

int Peer::heard() {
  int count = 0;
  for (const auto& read : dds_->readers) count += read();
  return count;
}

namespace {

template <class... Topics>
std::tuple<std::unique_ptr<Reader<Topics>>...> readers_of(Node& node, std::tuple<Topics...>) {
  return {std::make_unique<Reader<Topics>>(node)...};
}
template <class... Topics>
std::tuple<std::unique_ptr<Writer<Topics>>...> writers_of(Node& node, std::tuple<Topics...>) {
  return {std::make_unique<Writer<Topics>>(node)...};
}

}  // namespace

// The same endpoints on the library's own transport.
void Peer::Dds::be_the_open_victim(int domain, const std::string& identity) {
  participant = dds::DomainParticipantFactory::get_instance()->create_participant(
      domain, open_qos("victim", identity));
  if (!participant) throw std::runtime_error("the victim cannot join");
  publisher = participant->create_publisher(dds::PUBLISHER_QOS_DEFAULT);
  subscriber = participant->create_subscriber(dds::SUBSCRIBER_QOS_DEFAULT);
  std::apply([this](auto... topic) { (add_reader<decltype(topic)>(), ...); }, ToVictim{});
  std::apply([this](auto... topic) { (add_writer<decltype(topic)>(), ...); }, FromVictim{});
  while (true) {
    for (const auto& read : readers) read();
    for (const auto& write : writers) write();
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
}

void Peer::be_the_victim(int domain, bool filtered, const std::string& identity) {
  if (!filtered) Dds().be_the_open_victim(domain, identity);
  NodeOptions options;
  options.service = "victim";
  options.domain_id = domain;
  options.security = identity;
  Node node(options);
  const auto readers = readers_of(node, ToVictim{});
  const auto writers = writers_of(node, FromVictim{});
  node.announce();
  while (true) {
    std::apply([](auto&... reader) { (reader->take_newest(), ...); }, readers);
    std::apply([](auto&... writer) { (writer->write(), ...); }, writers);
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
}

}  // namespace foretrack::testing
