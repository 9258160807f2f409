// SPDX-License-Identifier: Apache-2.0
// What discovery tells of the others in the domain. Only .cpp files of this folder include it.
#pragma once

#include <atomic>
#include <cstdint>
#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantListener.hpp>
#include <map>
#include <mutex>
#include <set>
#include <string>
#include <vector>

#include "services/common/node.hpp"

namespace foretrack {

namespace dds = eprosima::fastdds::dds;

/// Compares every endpoint that discovery tells of with our own types; DDS is silent when the type
/// name or the key kind differs.
class DiscoveryWatch : public dds::DomainParticipantListener {
 public:
  explicit DiscoveryWatch(Node& node) : node_(node) {}

  /// From now on, this is what we expect on the topic. Also judges what was seen before.
  void expect(const std::string& topic, const TypeOps& ops);
  std::vector<ForeignEndpoint> foreign() const;
  std::vector<ForeignEndpoint> all() const;
  std::vector<Peer> peers() const;
  std::atomic<std::uint64_t> changes = 0;

  void on_participant_discovery(dds::DomainParticipant*,
                                eprosima::fastrtps::rtps::ParticipantDiscoveryInfo&& info) override;
  void onParticipantAuthentication(
      dds::DomainParticipant*,
      eprosima::fastrtps::rtps::ParticipantAuthenticationInfo&& info) override;
  void on_publisher_discovery(dds::DomainParticipant*,
                              eprosima::fastrtps::rtps::WriterDiscoveryInfo&& info) override;
  void on_subscriber_discovery(dds::DomainParticipant*,
                               eprosima::fastrtps::rtps::ReaderDiscoveryInfo&& info) override;

 private:
  using Guid = eprosima::fastrtps::rtps::GUID_t;
  struct Expected {
    std::string type;
    bool keyed;
  };
  void see(const Guid& guid, ForeignEndpoint seen);
  void judge(ForeignEndpoint& seen);

  Node& node_;
  mutable std::mutex mutex_;
  std::map<std::string, Expected> expected_;
  std::map<Guid, ForeignEndpoint> seen_;  // bounded
  std::map<PeerId, Peer> peers_;          // bounded
  std::set<std::string> versions_told_;   // topics of which it was said
};

PeerId peer_of(const eprosima::fastrtps::rtps::GUID_t& guid);
/// Infinity for an endless duration.
double seconds_of(const eprosima::fastrtps::Duration_t& duration);

}  // namespace foretrack
