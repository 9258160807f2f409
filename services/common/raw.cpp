// SPDX-License-Identifier: Apache-2.0
#include "services/common/raw.hpp"

#include <fastcdr/Cdr.h>
#include <fastcdr/FastBuffer.h>

#include <algorithm>
#include <fastdds/dds/core/condition/WaitSet.hpp>
#include <map>
#include <mutex>
#include <stdexcept>

#include "services/common/cdr_type.hpp"
#include "services/common/dds_impl.hpp"
#include "services/common/dds_log.hpp"
#include "services/common/raw_type.hpp"
#include "services/common/time_now.hpp"
#include "services/common/type_hash.hpp"

namespace foretrack {
namespace {

namespace rtps = eprosima::fastrtps::rtps;
using rtps::GUID_t;

constexpr std::size_t kHeaderBytes = 4;
// Cyclone DDS skips what a writer wrote before the first heartbeat that it hears of it, and Fast
// DDS sends none while there is nothing to repeat. So a new reader gets nobody's reply first.
constexpr std::size_t kNobodysBytes = 4 + 16 + 64;
constexpr double kSettled_s = 0.1;

// Every endpoint has a listener: without one, 2.9.1 crashes on some events.
struct QuietReader : dds::DataReaderListener {};
struct QuietWriter : dds::DataWriterListener {
  std::atomic<int> readers = 0;
  mutable std::mutex mutex;
  std::map<GUID_t, double> matched;  // when it was first written to; negative: not yet
  void on_publication_matched(dds::DataWriter*, const dds::PublicationMatchedStatus& s) override {
    readers = s.current_count;
    const auto reader = rtps::iHandle2GUID(s.last_subscription_handle);
    const std::lock_guard lock(mutex);
    if (s.current_count_change > 0)
      matched[reader] = -1.0;
    else
      matched.erase(reader);
  }
};

std::array<std::uint8_t, 16> bytes_of(const GUID_t& guid) {
  std::array<std::uint8_t, 16> bytes{};
  std::copy_n(guid.guidPrefix.value, 12, bytes.begin());
  std::copy_n(guid.entityId.value, 4, bytes.begin() + 12);
  return bytes;
}

GUID_t guid_of(const std::array<std::uint8_t, 16>& bytes) {
  GUID_t guid;
  std::copy_n(bytes.begin(), 12, guid.guidPrefix.value);
  std::copy_n(bytes.begin() + 12, 4, guid.entityId.value);
  return guid;
}

void tell_type(dds::UserDataQosPolicy& policy, const RawTopic& topic) {
  const auto told = told_of_type(topic.type);
  policy.data_vec(told);
}

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
  Node::Dds* of_node = nullptr;
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
  tell_type(qos.user_data(), topic);
  dds_->of_node = &of_node;
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

bool RawReader::take_request(CdrBytes& sample, RequestId& from) {
  while (true) {
    dds::SampleInfo info;
    if (dds_->reader->take_next_sample(&sample, &info) != ReturnCode_t::RETCODE_OK) return false;
    if (!info.valid_data) continue;
    from.writer = bytes_of(info.sample_identity.writer_guid());
    from.reader = bytes_of(info.related_sample_identity.writer_guid());
    from.number = static_cast<std::int64_t>(info.sample_identity.sequence_number().to64long());
    return true;
  }
}

void RawReader::show_to_ros() {
  dds_->of_node->shown_readers.push_back(dds_->reader->guid());
}

dds::StatusCondition& RawReader::condition() {
  return dds_->reader->get_statuscondition();
}

struct RawWriter::Dds {
  QuietWriter listener;
  Node::Dds* of_node = nullptr;
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
  tell_type(qos.user_data(), topic);
  dds_->of_node = &of_node;
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

bool RawWriter::reply(const CdrBytes& sample, const RequestId& to) {
  const auto number = static_cast<std::uint64_t>(to.number);
  rtps::WriteParams params;
  auto& identity = params.related_sample_identity();
  identity.writer_guid(guid_of(to.reader == RequestId().reader ? to.writer : to.reader));
  identity.sequence_number() = {static_cast<std::int32_t>(number >> 32),
                                static_cast<std::uint32_t>(number)};
  return dds_->writer->write(const_cast<CdrBytes*>(&sample), params);
}

bool RawWriter::reaches(const RequestId& asker) const {
  const GUID_t writer = guid_of(asker.writer), reader = guid_of(asker.reader);
  const bool names_reader = asker.reader != RequestId().reader;
  bool settled = false, first = false;
  {
    const std::lock_guard lock(dds_->listener.mutex);
    for (auto& [one, heard_s] : dds_->listener.matched) {
      if (names_reader ? one != reader : one.guidPrefix != writer.guidPrefix) continue;
      first = heard_s < 0.0;
      if (first) heard_s = steady_s();
      settled = steady_s() - heard_s > kSettled_s;
      break;
    }
  }
  if (names_reader) return first || settled;
  if (first) {  // without the lock: DDS has locks of its own
    CdrBytes nobodys(kNobodysBytes);
    nobodys[1] = 1;  // little-endian
    dds_->writer->write(&nobodys);
  }
  return settled;
}

void RawWriter::show_to_ros() {
  dds_->of_node->shown_writers.push_back(dds_->writer->guid());
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
  dds_->set.attach_condition(reader.condition());
}

void RawWait::remove(RawReader& reader) {
  dds_->set.detach_condition(reader.condition());
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
