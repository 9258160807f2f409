// SPDX-License-Identifier: Apache-2.0
// Nodes on a DDS domain of their own, waiting with a deadline, and a raw peer that can misbehave.
#pragma once

#include <gtest/gtest.h>

#include <chrono>
#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <fastdds/dds/topic/TypeSupport.hpp>
#include <string>
#include <thread>
#include <vector>

#include "services/common/node.hpp"
#include "services/launch/domain.hpp"

namespace foretrack::testing {

namespace dds = eprosima::fastdds::dds;

/// Every test program has a domain that nobody else on this machine uses.
inline int domain_id() {
  static const FreeDomain domain;
  return domain.id();
}

inline NodeOptions node_options(const std::string& service) {
  NodeOptions options;
  options.service = service;
  options.domain_id = domain_id();
  return options;
}

/// Polls the condition until it holds or the deadline passes.
template <class Condition>
bool eventually(Condition condition, double deadline_s = 10.0) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(deadline_s);
  while (std::chrono::steady_clock::now() < end) {
    if (condition()) return true;
    std::this_thread::yield();
  }
  return condition();
}

/// Bytes as they go over the wire, under any type name, keyed or not.
class RawType : public dds::TopicDataType {
 public:
  using Bytes = std::vector<unsigned char>;
  explicit RawType(const std::string& name, bool keyed = false) {
    setName(name.c_str());
    m_typeSize = 4096;
    m_isGetKeyDefined = keyed;
    auto_fill_type_object(false);
    auto_fill_type_information(false);
  }
  bool serialize(void* data, eprosima::fastrtps::rtps::SerializedPayload_t* payload) override {
    const auto& bytes = *static_cast<Bytes*>(data);
    std::copy(bytes.begin(), bytes.end(), payload->data);
    payload->length = static_cast<std::uint32_t>(bytes.size());
    return true;
  }
  bool deserialize(eprosima::fastrtps::rtps::SerializedPayload_t* payload, void* data) override {
    static_cast<Bytes*>(data)->assign(payload->data, payload->data + payload->length);
    return true;
  }
  std::function<uint32_t()> getSerializedSizeProvider(void* data) override {
    return [data] { return static_cast<std::uint32_t>(static_cast<Bytes*>(data)->size()); };
  }
  void* createData() override { return new Bytes; }
  void deleteData(void* data) override { delete static_cast<Bytes*>(data); }
  bool getKey(void*, eprosima::fastrtps::rtps::InstanceHandle_t* handle, bool) override {
    handle->value[0] = 1;
    return true;
  }
};

/// A participant that is not ours: default QoS, raw bytes.
class RawPeer {
 public:
  RawPeer(const std::string& topic, const std::string& type, bool keyed = false) {
    auto* factory = dds::DomainParticipantFactory::get_instance();
    participant_ = factory->create_participant(domain_id(), dds::PARTICIPANT_QOS_DEFAULT);
    dds::TypeSupport support(new RawType(type, keyed));
    support.register_type(participant_);
    topic_ = participant_->create_topic(topic, type, dds::TOPIC_QOS_DEFAULT);
    publisher_ = participant_->create_publisher(dds::PUBLISHER_QOS_DEFAULT);
    subscriber_ = participant_->create_subscriber(dds::SUBSCRIBER_QOS_DEFAULT);
  }
  ~RawPeer() {
    participant_->delete_contained_entities();
    dds::DomainParticipantFactory::get_instance()->delete_participant(participant_);
  }
  dds::DataWriter* add_writer(
      dds::ReliabilityQosPolicyKind reliability = dds::RELIABLE_RELIABILITY_QOS,
      const std::string& user_data = "") {
    dds::DataWriterQos qos;
    qos.user_data().data_vec({user_data.begin(), user_data.end()});
    qos.reliability().kind = reliability;
    qos.history().depth = 10;
    qos.endpoint().history_memory_policy =
        eprosima::fastrtps::rtps::PREALLOCATED_WITH_REALLOC_MEMORY_MODE;
    return publisher_->create_datawriter(topic_, qos);
  }
  dds::DataReader* add_reader(const dds::DataReaderQos& qos = dds::DATAREADER_QOS_DEFAULT) {
    return subscriber_->create_datareader(topic_, qos);
  }

 private:
  dds::DomainParticipant* participant_;
  dds::Topic* topic_;
  dds::Publisher* publisher_;
  dds::Subscriber* subscriber_;
};

inline int readers_of(dds::DataWriter* writer) {
  dds::PublicationMatchedStatus status;
  writer->get_publication_matched_status(status);
  return status.current_count;
}

}  // namespace foretrack::testing
