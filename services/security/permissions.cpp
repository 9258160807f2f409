// SPDX-License-Identifier: Apache-2.0
#include "services/security/permissions.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include "services/common/ros_graph.hpp"
#include "services/common/topics.hpp"

namespace foretrack::security {
namespace {

constexpr std::time_t kDay_s = 86400;
constexpr int kHighestDomain = 232;
constexpr char kHead[] =
    "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
    "<dds xmlns:xsi=\"http://www.w3.org/2001/XMLSchema-instance\">\n";

template <class... Topics>
constexpr bool all_name_writers(std::tuple<Topics...>*) {
  return (... && !Topics::info.writers.empty());
}
static_assert(all_name_writers(static_cast<topics::All*>(nullptr)),
              "a topic does not say who may write it (topics.hpp)");

std::string domains(int domain_id) {
  return fmt::format("<domains><id_range><min>{}</min><max>{}</max></id_range></domains>",
                     domain_id < 0 ? 0 : domain_id, domain_id < 0 ? kHighestDomain : domain_id);
}

// Whatever PX4's release.
void add_topic(std::vector<std::string>& names, const TopicInfo& info, const Names& of) {
  const auto plain = unversioned_topic_name(info, of);
  names.push_back(plain);
  if (info.scope == Scope::kPx4) names.push_back(plain + "_v*");
}

template <class... Topics>
void add_topics(std::vector<std::string>& names, Role role, const Names& of,
                std::tuple<Topics...>*) {
  (..., (Topics::info.writers.has(role) ? add_topic(names, Topics::info, of) : void()));
}

// A day more on both sides, since the library reads it as local time; the certificate is exact.
std::string validity_text(const Validity& validity) {
  return fmt::format(
      "<validity><not_before>{:%Y-%m-%dT%H:%M:%S}</not_before>"
      "<not_after>{:%Y-%m-%dT%H:%M:%S}</not_after></validity>",
      fmt::gmtime(validity.from - kDay_s), fmt::gmtime(validity.until + kDay_s));
}

}  // namespace

std::vector<std::string> writable_topics(Role role, const Names& names) {
  std::vector<std::string> result = {kRosGraphTopic};
  add_topics(result, role, names, static_cast<topics::All*>(nullptr));
  return result;
}

std::string governance_text() {
  return fmt::format(R"({}<domain_access_rules><domain_rule>
{}
<allow_unauthenticated_participants>false</allow_unauthenticated_participants>
<enable_join_access_control>true</enable_join_access_control>
<discovery_protection_kind>ENCRYPT</discovery_protection_kind>
<liveliness_protection_kind>ENCRYPT</liveliness_protection_kind>
<rtps_protection_kind>SIGN</rtps_protection_kind>
<topic_access_rules><topic_rule><topic_expression>*</topic_expression>
<enable_discovery_protection>true</enable_discovery_protection>
<enable_liveliness_protection>true</enable_liveliness_protection>
<enable_read_access_control>true</enable_read_access_control>
<enable_write_access_control>true</enable_write_access_control>
<metadata_protection_kind>ENCRYPT_WITH_ORIGIN_AUTHENTICATION</metadata_protection_kind>
<data_protection_kind>NONE</data_protection_kind>
</topic_rule></topic_access_rules></domain_rule></domain_access_rules></dds>
)",
                     kHead, domains(-1));
}

std::string permissions_text(const Grant& grant) {
  std::string topics;
  for (const auto& topic : writable_topics(grant.role, grant.names))
    topics += fmt::format("<topic>{}</topic>\n", topic);
  return fmt::format(R"({}<permissions><grant name="{}">
<subject_name>{}</subject_name>
{}
<allow_rule>{}
<publish><topics>
{}</topics></publish>
<subscribe><topics><topic>*</topic></topics></subscribe>
</allow_rule>
<default>DENY</default></grant></permissions></dds>
)",
                     kHead, name_of(grant.role), grant.subject, validity_text(grant.validity),
                     domains(grant.domain_id), topics);
}

}  // namespace foretrack::security
