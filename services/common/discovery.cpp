// What discovery tells, and what we tell ROS 2's tools.
#include <array>
#include <cstring>

#include "rmw_dds_common/msg/ParticipantEntitiesInfo.h"
#include "services/common/dds_impl.hpp"

namespace foretrack {
namespace {

using eprosima::fastrtps::rtps::GUID_t;

// Malformed discovery traffic must not fill the memory.
constexpr std::size_t kMaxSeen = 4096;

template <class Info>
ForeignEndpoint describe(const Info& info, bool writes) {
  return {info.topicName().to_string(), info.typeName().to_string(),
          info.topicKind() == eprosima::fastrtps::rtps::WITH_KEY, writes, ""};
}

rmw_dds_common::msg::Gid gid_of(const GUID_t& guid) {
  rmw_dds_common::msg::Gid gid;
  gid.data().fill(0);
  std::memcpy(gid.data().data(), guid.guidPrefix.value, 12);
  std::memcpy(gid.data().data() + 12, guid.entityId.value, 4);
  return gid;
}

}  // namespace

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
  const std::lock_guard lock(mutex_);
  judge(seen);
  if (seen_.size() < kMaxSeen || seen_.contains(guid)) seen_[guid] = std::move(seen);
}

std::vector<ForeignEndpoint> DiscoveryWatch::foreign() const {
  const std::lock_guard lock(mutex_);
  std::vector<ForeignEndpoint> result;
  for (const auto& [guid, seen] : seen_)
    if (!seen.why.empty()) result.push_back(seen);
  return result;
}

void DiscoveryWatch::on_publisher_discovery(dds::DomainParticipant*,
                                            eprosima::fastrtps::rtps::WriterDiscoveryInfo&& info) {
  using Info = eprosima::fastrtps::rtps::WriterDiscoveryInfo;
  if (info.status == Info::DISCOVERED_WRITER)
    return see(info.info.guid(), describe(info.info, true));
  if (info.status != Info::REMOVED_WRITER) return;
  const std::lock_guard lock(mutex_);
  seen_.erase(info.info.guid());
}

void DiscoveryWatch::on_subscriber_discovery(dds::DomainParticipant*,
                                             eprosima::fastrtps::rtps::ReaderDiscoveryInfo&& info) {
  using Info = eprosima::fastrtps::rtps::ReaderDiscoveryInfo;
  if (info.status == Info::DISCOVERED_READER)
    return see(info.info.guid(), describe(info.info, false));
  if (info.status != Info::REMOVED_READER) return;
  const std::lock_guard lock(mutex_);
  seen_.erase(info.info.guid());
}

void Node::announce() {
  using Info = rmw_dds_common::msg::ParticipantEntitiesInfo;
  if (!dds_->ros_discovery) {
    dds::DataWriterQos qos;
    dds_->publisher->get_datawriter_qos_from_profile("latched", qos);
    dds_->ros_discovery = dds_->publisher->create_datawriter(
        dds_->topic("ros_discovery_info", type_ops<Info>()), qos);
  }
  rmw_dds_common::msg::NodeEntitiesInfo node;
  node.node_namespace("/" + options_.names.vehicle);
  node.node_name(options_.service);
  for (const auto& w : writers_) node.writer_gid_seq().push_back(gid_of(w->dds->writer->guid()));
  for (const auto& r : readers_) node.reader_gid_seq().push_back(gid_of(r->dds->reader->guid()));
  Info info;
  info.gid(gid_of(dds_->participant->guid()));
  info.node_entities_info_seq().push_back(node);
  if (dds_->ros_discovery) dds_->ros_discovery->write(&info);
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
