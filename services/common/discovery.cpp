// SPDX-License-Identifier: Apache-2.0
#include "services/common/discovery.hpp"

#include <algorithm>
#include <limits>

#include "services/common/dds_impl.hpp"
#include "services/common/time_now.hpp"
#include "services/common/type_hash.hpp"

namespace foretrack {
namespace {

using eprosima::fastrtps::rtps::GUID_t;

// Malformed discovery traffic must not fill the memory.
constexpr std::size_t kMaxSeen = 4096;

template <class Info>
ToldOfType told_by(const Info& info) {
  const auto& told = info.m_qos.m_userData;
  return read_told({told.begin(), told.end()});
}

template <class Info>
ForeignEndpoint describe(const Info& info, bool writes) {
  return {info.topicName().to_string(),
          info.typeName().to_string(),
          info.topicKind() == eprosima::fastrtps::rtps::WITH_KEY,
          writes,
          "",
          info.m_qos.m_reliability.kind == dds::RELIABLE_RELIABILITY_QOS,
          info.m_qos.m_durability.kind >= dds::TRANSIENT_LOCAL_DURABILITY_QOS,
          peer_of(info.guid()),
          other_version(info.typeName().to_string(), told_by(info))};
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
  if (!seen.other_version.empty() && versions_told_.size() < kMaxSeen &&
      versions_told_.insert(seen.topic).second)
    node_.report("on " + seen.topic + ", " + seen.other_version + ": it is misread");
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
    peers_[id] = {id, info.info.m_participantName.to_string(),
                  seconds_of(info.info.m_leaseDuration), steady_s()};
  }
}

void DiscoveryWatch::onParticipantAuthentication(
    dds::DomainParticipant*, eprosima::fastrtps::rtps::ParticipantAuthenticationInfo&& info) {
  using Info = eprosima::fastrtps::rtps::ParticipantAuthenticationInfo;
  if (info.status == Info::UNAUTHORIZED_PARTICIPANT)
    node_.refuse_peer(wire::Fault::kIdentity, "a participant");
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

}  // namespace foretrack
