// SPDX-License-Identifier: Apache-2.0
#include "services/common/endpoint.hpp"

#include <algorithm>
#include <stdexcept>

#include "services/common/cdr_type.hpp"
#include "services/common/dds_impl.hpp"
#include "services/common/dds_log.hpp"
#include "services/common/px4_type.hpp"
#include "services/common/type_hash.hpp"

namespace foretrack {

void EndpointStats::accept() {
  ++samples;
  last = std::chrono::steady_clock::now();
}

void EndpointStats::reject(std::string_view reason) {
  for (auto& [known, count] : rejected)
    if (known == reason) {
      ++count;
      return;
    }
  rejected.emplace_back(reason, 1);
}

std::uint64_t EndpointStats::rejected_for(std::string_view reason) const {
  for (const auto& [known, count] : rejected)
    if (known == reason) return count;
  return 0;
}

double EndpointStats::age_s() const {
  if (samples == 0) return -1.0;
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - last).count();
}

namespace {

// "RELIABILITY", for a message to an operator.
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

// Only where it is true: PX4's types change with its release.
void tell_type(dds::UserDataQosPolicy& policy, const Node& node, const TypeOps& ops) {
  if (Px4Type::is_needed(ops, node.options().names.px4_release)) return;
  const auto told = told_of_type(ops.name);
  policy.data_vec(told);
}

[[noreturn]] void no_profile(const TopicInfo& info) {
  throw std::runtime_error("qos/profiles.xml has no usable profile '" + std::string(info.profile) +
                           "' for topic " + std::string(info.name));
}

// Security refuses a writer or reader that the identity's permissions do not allow.
[[noreturn]] void refused(const EndpointStats& stats) {
  const std::string why = security_complaint();
  throw std::runtime_error(std::string("DDS refuses to ") + (stats.writes ? "write " : "read ") +
                           stats.topic + (why.empty() ? "" : ": " + why));
}

}  // namespace

WriterCore::WriterCore(Node& node, const TopicInfo& info, const TypeOps& ops)
    : dds(std::make_unique<Dds>(node, stats)) {
  stats.topic = topic_name(info, node.options().names);
  stats.profile = info.profile;
  stats.writes = true;
  auto& of_node = node.dds();
  dds::DataWriterQos qos;
  if (of_node.publisher->get_datawriter_qos_from_profile(info.profile, qos) !=
      ReturnCode_t::RETCODE_OK)
    no_profile(info);
  if (std::string_view(info.profile) == kMapFlow)
    qos.publish_mode().flow_controller_name = kMapFlow;
  tell_type(qos.user_data(), node, ops);
  const auto mask = dds::StatusMask::publication_matched()
                    << dds::StatusMask::offered_incompatible_qos();
  dds->writer =
      of_node.publisher->create_datawriter(of_node.topic(stats.topic, ops), qos, dds.get(), mask);
  if (!dds->writer) refused(stats);
}

WriterCore::~WriterCore() = default;

bool WriterCore::write(const void* sample) {
  if (!dds->writer->write(const_cast<void*>(sample))) {
    stats.reject("DDS refused the sample");
    return false;
  }
  stats.accept();
  return true;
}

ReaderCore::ReaderCore(Node& node, const TopicInfo& info, const TypeOps& ops)
    : dds(std::make_unique<Dds>(node, stats)), node_(node), info_(info), ops_(ops) {
  stats.topic = topic_name(info, node.options().names);
  stats.profile = info.profile;
  dds->any_writer = info.any_writer;
  make_reader(false);
}

void ReaderCore::make_reader(bool best_effort) {
  auto& of_node = node_.dds();
  dds::DataReaderQos qos;
  if (of_node.subscriber->get_datareader_qos_from_profile(info_.profile, qos) !=
      ReturnCode_t::RETCODE_OK)
    no_profile(info_);
  if (best_effort) qos.reliability().kind = dds::BEST_EFFORT_RELIABILITY_QOS;
  tell_type(qos.user_data(), node_, ops_);
  const auto mask = dds::StatusMask::subscription_matched()
                    << dds::StatusMask::requested_incompatible_qos()
                    << dds::StatusMask::sample_lost();
  dds->reader =
      of_node.subscriber->create_datareader(of_node.topic(stats.topic, ops_), qos, dds.get(), mask);
  if (!dds->reader) refused(stats);
  dds->reader->get_statuscondition().set_enabled_statuses(dds::StatusMask::data_available());
}

bool ReaderCore::wants_best_effort() const {
  return dds->wants_best_effort;
}

void ReaderCore::hear_best_effort() {
  dds->wants_best_effort = dds->any_writer = false;
  dds->reader->set_listener(nullptr);
  node_.dds().subscriber->delete_datareader(dds->reader);
  stats.peers = 0;
  stats.incompatible_qos = 0;
  make_reader(true);
  if (node_.dds().ros_discovery) node_.announce();  // again
}

ReaderCore::~ReaderCore() = default;

bool ReaderCore::take(void* sample) {
  if (!waited_for && wants_best_effort()) hear_best_effort();
  while (true) {
    const std::uint64_t malformed_before = malformed_samples();
    dds::SampleInfo info;
    const auto result = dds->reader->take_next_sample(sample, &info);
    const std::uint64_t malformed = malformed_samples() - malformed_before;
    for (std::uint64_t i = 0; i < malformed; ++i) stats.reject("malformed CDR");
    if (result == ReturnCode_t::RETCODE_OK && info.valid_data) {
      const eprosima::fastrtps::rtps::GUID_t& guid = info.sample_identity.writer_guid();
      WriterId from{};
      std::copy_n(guid.guidPrefix.value, 12, from.begin());
      std::copy_n(guid.entityId.value, 4, from.begin() + 12);
      if (is_of_the_pinned_writer(from)) return true;
      if (!refuses_others_) {
        ++stats.of_second_writers;
        return true;
      }
      stats.reject(kSecondWriter);
      continue;
    }
    if (result != ReturnCode_t::RETCODE_OK && malformed == 0) return false;
  }
}

bool ReaderCore::is_of_the_pinned_writer(const WriterId& from) {
  if (pin_silence_s_ < 0.0) return true;
  const auto now = std::chrono::steady_clock::now();
  const std::chrono::duration<double> silence = now - pinned_heard_;
  const bool is_pinned = from == pinned_;
  if (!is_pinned && pinned_ != WriterId{} && silence.count() < pin_silence_s_) return false;
  pinned_ = from;
  pinned_heard_ = now;
  return true;
}

void WriterCore::Dds::on_publication_matched(dds::DataWriter*,
                                             const dds::PublicationMatchedStatus& s) {
  stats.peers = s.current_count;
}

void WriterCore::Dds::on_offered_incompatible_qos(dds::DataWriter*,
                                                  const dds::OfferedIncompatibleQosStatus& s) {
  node.report("a reader of " + stats.topic + " asks for more " + policy_name(s.last_policy_id) +
              " than profile '" + stats.profile + "' offers; it gets nothing");
  stats.incompatible_qos = s.total_count;
}

void ReaderCore::Dds::on_subscription_matched(dds::DataReader*,
                                              const dds::SubscriptionMatchedStatus& s) {
  stats.peers = s.current_count;
}

void ReaderCore::Dds::on_requested_incompatible_qos(dds::DataReader*,
                                                    const dds::RequestedIncompatibleQosStatus& s) {
  if (any_writer && s.last_policy_id == dds::RELIABILITY_QOS_POLICY_ID) {
    wants_best_effort = true;
    return;
  }
  node.report("a writer of " + stats.topic + " offers less " + policy_name(s.last_policy_id) +
              " than profile '" + stats.profile + "' asks for; nothing is received from it");
  stats.incompatible_qos = s.total_count;
}

void ReaderCore::Dds::on_sample_lost(dds::DataReader*, const dds::SampleLostStatus& s) {
  stats.lost = s.total_count;
}

}  // namespace foretrack
