// SPDX-License-Identifier: Apache-2.0
// What discovery tells, and what we tell ROS 2's tools.
#include <algorithm>
#include <chrono>
#include <cstring>
#include <limits>
#include <type_traits>

#include "rmw_dds_common/msg/ParticipantEntitiesInfo.h"
#include "rmw_dds_common/msg/ParticipantEntitiesInfo16.h"
#include "services/common/dds_impl.hpp"

namespace foretrack {
namespace {

using eprosima::fastrtps::rtps::GUID_t;

// Malformed discovery traffic must not fill the memory.
constexpr std::size_t kMaxSeen = 4096;

template <class Info>
ForeignEndpoint describe(const Info& info, bool writes) {
  return {info.topicName().to_string(),
          info.typeName().to_string(),
          info.topicKind() == eprosima::fastrtps::rtps::WITH_KEY,
          writes,
          "",
          info.m_qos.m_reliability.kind == dds::RELIABLE_RELIABILITY_QOS,
          info.m_qos.m_durability.kind >= dds::TRANSIENT_LOCAL_DURABILITY_QOS,
          peer_of(info.guid())};
}

// 12 bytes of prefix, 4 of entity id, zeros to the end.
template <class Gid>
Gid gid_of(const GUID_t& guid) {
  Gid gid;
  gid.data().fill(0);
  std::memcpy(gid.data().data(), guid.guidPrefix.value, 12);
  std::memcpy(gid.data().data() + 12, guid.entityId.value, 4);
  return gid;
}

// Info as the distribution of ROS 2 has it.
template <class Info>
void write_info(Node& node) {
  using NodeInfo = typename std::decay_t<decltype(Info().node_entities_info_seq())>::value_type;
  using Gid = std::decay_t<decltype(Info().gid())>;
  auto& of_node = node.dds();
  if (!of_node.ros_discovery) {
    auto ops = type_ops<Info>();
    ops.name = TypeName<rmw_dds_common::msg::ParticipantEntitiesInfo>::value;
    dds::DataWriterQos qos;
    of_node.publisher->get_datawriter_qos_from_profile("latched", qos);
    of_node.ros_discovery =
        of_node.publisher->create_datawriter(of_node.topic("ros_discovery_info", ops), qos);
  }
  Info info;
  info.gid(gid_of<Gid>(of_node.participant->guid()));
  NodeInfo entities;
  entities.node_namespace("/" + node.options().names.vehicle);
  entities.node_name(node.options().service);
  for (const auto& w : node.writers())
    entities.writer_gid_seq().push_back(gid_of<Gid>(w->dds->writer->guid()));
  for (const auto& r : node.readers())
    entities.reader_gid_seq().push_back(gid_of<Gid>(r->dds->reader->guid()));
  info.node_entities_info_seq().push_back(entities);
  if (of_node.ros_discovery) of_node.ros_discovery->write(&info);
}

}  // namespace

PeerId peer_of(const GUID_t& guid) {
  PeerId id;
  std::copy_n(guid.guidPrefix.value, id.size(), id.begin());
  return id;
}

double seconds_of(const eprosima::fastrtps::Duration_t& duration) {
  return duration == eprosima::fastrtps::c_TimeInfinite
             ? std::numeric_limits<double>::infinity()
             : duration.seconds + 1e-9 * duration.nanosec;
}

void DiscoveryWatch::judge(ForeignEndpoint& seen) {
  const auto it = expected_.find(seen.topic);
  if (it == expected_.end() || !seen.why.empty()) return;
  if (seen.type != it->second.type)
    seen.why = "its type is " + seen.type + ", ours " + it->second.type;
  else if (seen.keyed != it->second.keyed)
    seen.why = seen.keyed ? "its type has a key, ours has none" : "its type lacks our key";
  if (!seen.why.empty())
    node_.report("a foreign " + std::string(seen.writes ? "writer" : "reader") + " on " +
                 seen.topic + " will never match: " + seen.why);
}

void DiscoveryWatch::expect(const std::string& topic, const TypeOps& ops) {
  const std::lock_guard lock(mutex_);
  expected_[topic] = {ops.name, ops.keyed};
  for (auto& [guid, seen] : seen_)
    if (seen.topic == topic) judge(seen);
}

void DiscoveryWatch::see(const Guid& guid, ForeignEndpoint seen) {
  const auto* own = node_.dds().participant;
  if (own && guid.guidPrefix == own->guid().guidPrefix) return;
  const std::lock_guard lock(mutex_);
  judge(seen);
  if (seen_.size() < kMaxSeen || seen_.contains(guid)) seen_[guid] = std::move(seen);
  ++changes;
}

std::vector<ForeignEndpoint> DiscoveryWatch::foreign() const {
  const std::lock_guard lock(mutex_);
  std::vector<ForeignEndpoint> result;
  for (const auto& [guid, seen] : seen_)
    if (!seen.why.empty()) result.push_back(seen);
  return result;
}

std::vector<ForeignEndpoint> DiscoveryWatch::all() const {
  const std::lock_guard lock(mutex_);
  std::vector<ForeignEndpoint> result;
  for (const auto& [guid, seen] : seen_) result.push_back(seen);
  return result;
}

std::vector<Peer> DiscoveryWatch::peers() const {
  const std::lock_guard lock(mutex_);
  std::vector<Peer> result;
  for (const auto& [id, peer] : peers_) result.push_back(peer);
  return result;
}

void DiscoveryWatch::on_participant_discovery(
    dds::DomainParticipant*, eprosima::fastrtps::rtps::ParticipantDiscoveryInfo&& info) {
  using Info = eprosima::fastrtps::rtps::ParticipantDiscoveryInfo;
  const auto id = peer_of(info.info.m_guid);
  const std::lock_guard lock(mutex_);
  if (info.status == Info::REMOVED_PARTICIPANT || info.status == Info::DROPPED_PARTICIPANT) {
    peers_.erase(id);
  } else if (info.status == Info::DISCOVERED_PARTICIPANT && peers_.size() < kMaxSeen) {
    const auto now = std::chrono::steady_clock::now().time_since_epoch();
    peers_[id] = {id, info.info.m_participantName.to_string(),
                  seconds_of(info.info.m_leaseDuration),
                  std::chrono::duration<double>(now).count()};
  }
}

void DiscoveryWatch::on_publisher_discovery(dds::DomainParticipant*,
                                            eprosima::fastrtps::rtps::WriterDiscoveryInfo&& info) {
  using Info = eprosima::fastrtps::rtps::WriterDiscoveryInfo;
  if (info.status == Info::DISCOVERED_WRITER)
    return see(info.info.guid(), describe(info.info, true));
  if (info.status != Info::REMOVED_WRITER) return;
  const std::lock_guard lock(mutex_);
  seen_.erase(info.info.guid());
  ++changes;
}

void DiscoveryWatch::on_subscriber_discovery(dds::DomainParticipant*,
                                             eprosima::fastrtps::rtps::ReaderDiscoveryInfo&& info) {
  using Info = eprosima::fastrtps::rtps::ReaderDiscoveryInfo;
  if (info.status == Info::DISCOVERED_READER)
    return see(info.info.guid(), describe(info.info, false));
  if (info.status != Info::REMOVED_READER) return;
  const std::lock_guard lock(mutex_);
  seen_.erase(info.info.guid());
  ++changes;
}

void Node::announce() {
  if (options_.ros == RosDistribution::kHumble)
    write_info<rmw_dds_common::msg::ParticipantEntitiesInfo>(*this);
  else
    write_info<rmw_dds_common::msg::ParticipantEntitiesInfo16>(*this);
}

std::string policy_name(dds::QosPolicyId_t id) {
  switch (id) {
    case dds::DURABILITY_QOS_POLICY_ID:
      return "DURABILITY";
    case dds::RELIABILITY_QOS_POLICY_ID:
      return "RELIABILITY";
    case dds::DEADLINE_QOS_POLICY_ID:
      return "DEADLINE";
    case dds::LIVELINESS_QOS_POLICY_ID:
      return "LIVELINESS";
    case dds::OWNERSHIP_QOS_POLICY_ID:
      return "OWNERSHIP";
    case dds::DATAREPRESENTATION_QOS_POLICY_ID:
      return "DATA REPRESENTATION";
    default:
      return "policy " + std::to_string(static_cast<int>(id));
  }
}

}  // namespace foretrack
