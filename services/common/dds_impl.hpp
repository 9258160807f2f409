// SPDX-License-Identifier: Apache-2.0
// The DDS halves of Node, its endpoints and Stop. Only .cpp files of this folder include it.
#pragma once

#include <atomic>
#include <fastdds/dds/core/condition/GuardCondition.hpp>
#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/DataWriterListener.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/DataReaderListener.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <map>
#include <mutex>
#include <string>
#include <vector>

#include "services/common/discovery.hpp"
#include "services/common/endpoint.hpp"
#include "services/common/node.hpp"
#include "services/common/stop.hpp"

namespace foretrack {

using eprosima::fastrtps::types::ReturnCode_t;

/// The flow controller of profile "map".
inline constexpr char kMapFlow[] = "map";

struct Stop::Dds {
  dds::GuardCondition condition;
};

struct Node::Dds {
  explicit Dds(Node& node) : watch(node) {}

  dds::Topic* topic(const std::string& name, const TypeOps& ops);

  DiscoveryWatch watch;
  dds::DomainParticipant* participant = nullptr;
  dds::Publisher* publisher = nullptr;
  dds::Subscriber* subscriber = nullptr;
  std::map<std::string, dds::Topic*> topics;
  std::string px4_release;
  std::mutex raw_mutex;  // raw endpoints may be made by several threads
  dds::DataWriter* ros_discovery = nullptr;
  // Of services of ROS 2, announced besides the node's own.
  std::vector<eprosima::fastrtps::rtps::GUID_t> shown_writers, shown_readers;
  mutable std::mutex error_mutex;
  std::string last_error;
};

struct WriterCore::Dds : dds::DataWriterListener {
  Dds(Node& owner, EndpointStats& counts) : node(owner), stats(counts) {}
  void on_publication_matched(dds::DataWriter*, const dds::PublicationMatchedStatus& s) override;
  void on_offered_incompatible_qos(dds::DataWriter*,
                                   const dds::OfferedIncompatibleQosStatus& s) override;

  Node& node;
  EndpointStats& stats;
  dds::DataWriter* writer = nullptr;
};

struct ReaderCore::Dds : dds::DataReaderListener {
  Dds(Node& owner, EndpointStats& counts) : node(owner), stats(counts) {}
  void on_subscription_matched(dds::DataReader*, const dds::SubscriptionMatchedStatus& s) override;
  void on_requested_incompatible_qos(dds::DataReader*,
                                     const dds::RequestedIncompatibleQosStatus& s) override;
  void on_sample_lost(dds::DataReader*, const dds::SampleLostStatus& s) override;

  Node& node;
  EndpointStats& stats;
  dds::DataReader* reader = nullptr;
  bool any_writer = false;                      // and the reader is still reliable
  std::atomic<bool> wants_best_effort = false;  // a writer is there that is not reliable
};

}  // namespace foretrack
