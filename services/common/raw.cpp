// SPDX-License-Identifier: Apache-2.0
#include "services/common/raw.hpp"

#include <fastcdr/Cdr.h>
#include <fastcdr/FastBuffer.h>

#include <fastdds/dds/core/condition/WaitSet.hpp>
#include <stdexcept>

#include "services/common/cdr_type.hpp"
#include "services/common/dds_impl.hpp"
#include "services/common/dds_log.hpp"
#include "services/common/raw_type.hpp"

namespace foretrack {
namespace {

constexpr std::size_t kHeaderBytes = 4;

// Every endpoint has a listener: without one, 2.9.1 crashes on some events.
struct QuietReader : dds::DataReaderListener {};
struct QuietWriter : dds::DataWriterListener {
  std::atomic<int> readers = 0;
  void on_publication_matched(dds::DataWriter*, const dds::PublicationMatchedStatus& s) override {
    readers = s.current_count;
  }
};

[[noreturn]] void refused(const RawTopic& topic, const std::string& what) {
  const std::string why = security_complaint();
  throw std::runtime_error("DDS refuses " + what + " " + topic.name + " of type " + topic.type +
                           (why.empty() ? "" : ": " + why));
}

// A topic that another type had, and that nobody uses any more, makes room.
dds::Topic* topic_of(Node::Dds& node, const RawTopic& topic) {
  const std::lock_guard lock(node.raw_mutex);
  if (const auto it = node.topics.find(topic.name); it != node.topics.end()) {
    if (it->second->get_type_name() == topic.type) return it->second;
    if (node.participant->delete_topic(it->second) != ReturnCode_t::RETCODE_OK)
      refused(topic, "a second type for topic");
    node.topics.erase(it);
  }
  const auto known = node.participant->find_type(topic.type);
  if (known && !dynamic_cast<const RawType*>(known.get())) refused(topic, "a raw topic");
  if (!known) {
    dds::TypeSupport type(new RawType(topic.type, topic.keyed));
    if (type.register_type(node.participant) != ReturnCode_t::RETCODE_OK) refused(topic, "topic");
  }
  auto* made = node.participant->create_topic(topic.name, topic.type, dds::TOPIC_QOS_DEFAULT);
  if (!made) refused(topic, "topic");
  return node.topics[topic.name] = made;
}

}  // namespace

struct RawReader::Dds {
  QuietReader listener;
  dds::Subscriber* subscriber = nullptr;
  dds::DataReader* reader = nullptr;
};

RawReader::RawReader(Node& node, const RawTopic& topic, const char* profile)
    : dds_(std::make_unique<Dds>()) {
  auto& of_node = node.dds();
  dds_->subscriber = of_node.subscriber;
  dds::DataReaderQos qos;
  if (dds_->subscriber->get_datareader_qos_from_profile(profile, qos) != ReturnCode_t::RETCODE_OK)
    refused(topic, std::string("profile ") + profile + " for");
  dds_->reader = dds_->subscriber->create_datareader(topic_of(of_node, topic), qos, &dds_->listener,
                                                     dds::StatusMask::none());
  if (!dds_->reader) refused(topic, "a reader of");
  dds_->reader->get_statuscondition().set_enabled_statuses(dds::StatusMask::data_available());
}

RawReader::~RawReader() {
  dds_->subscriber->delete_datareader(dds_->reader);
}

bool RawReader::take(CdrBytes& sample, PeerId* from) {
  while (true) {
    dds::SampleInfo info;
    if (dds_->reader->take_next_sample(&sample, &info) != ReturnCode_t::RETCODE_OK) return false;
    if (!info.valid_data) continue;
    if (from) *from = peer_of(info.sample_identity.writer_guid());
    return true;
  }
}

struct RawWriter::Dds {
  QuietWriter listener;
  dds::Publisher* publisher = nullptr;
  dds::DataWriter* writer = nullptr;
};

RawWriter::RawWriter(Node& node, const RawTopic& topic, const char* profile)
    : dds_(std::make_unique<Dds>()) {
  auto& of_node = node.dds();
  dds_->publisher = of_node.publisher;
  dds::DataWriterQos qos;
  if (dds_->publisher->get_datawriter_qos_from_profile(profile, qos) != ReturnCode_t::RETCODE_OK)
    refused(topic, std::string("profile ") + profile + " for");
  dds_->writer = dds_->publisher->create_datawriter(topic_of(of_node, topic), qos, &dds_->listener,
                                                    dds::StatusMask::publication_matched());
  if (!dds_->writer) refused(topic, "a writer of");
}

RawWriter::~RawWriter() {
  dds_->publisher->delete_datawriter(dds_->writer);
}

bool RawWriter::write(const CdrBytes& sample) {
  return dds_->writer->write(const_cast<CdrBytes*>(&sample));
}

int RawWriter::readers() const {
  return dds_->listener.readers;
}

struct RawWait::Dds {
  dds::WaitSet set;
};

RawWait::RawWait() : dds_(std::make_unique<Dds>()) {}
RawWait::~RawWait() = default;

void RawWait::add(RawReader& reader) {
  dds_->set.attach_condition(reader.dds().reader->get_statuscondition());
}

void RawWait::remove(RawReader& reader) {
  dds_->set.detach_condition(reader.dds().reader->get_statuscondition());
}

void RawWait::wait(double longest_s) {
  dds::ConditionSeq active;
  const auto whole = static_cast<std::int32_t>(longest_s);
  dds_->set.wait(active, {whole, static_cast<std::uint32_t>(1e9 * (longest_s - whole))});
}

CdrBytes to_cdr(const TypeOps& ops, const void* sample) {
  using eprosima::fastcdr::Cdr;
  CdrBytes bytes(ops.size(sample) + kHeaderBytes);
  eprosima::fastcdr::FastBuffer buffer(reinterpret_cast<char*>(bytes.data()), bytes.size());
  Cdr cdr(buffer, Cdr::DEFAULT_ENDIAN, Cdr::DDS_CDR);
  cdr.serialize_encapsulation();
  ops.serialize(sample, cdr);
  bytes.resize(cdr.getSerializedDataLength());
  return bytes;
}

bool from_cdr(const TypeOps& ops, const CdrBytes& bytes, void* sample) try {
  using eprosima::fastcdr::Cdr;
  auto* data = reinterpret_cast<char*>(const_cast<std::uint8_t*>(bytes.data()));
  eprosima::fastcdr::FastBuffer buffer(data, bytes.size());
  Cdr cdr(buffer, Cdr::DEFAULT_ENDIAN, Cdr::DDS_CDR);
  cdr.read_encapsulation();
  ops.deserialize(sample, cdr);
  return true;
} catch (...) {  // as in CdrType: generated code throws on malformed bytes
  return false;
}

}  // namespace foretrack
