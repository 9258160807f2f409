// SPDX-License-Identifier: Apache-2.0
#include "services/common/participant.hpp"

#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <mutex>
#include <stdexcept>

#include "services/common/dds_impl.hpp"
#include "services/common/filter_transport.hpp"
#include "services/common/identity.hpp"
#include "services/common/interfaces.hpp"
#include "services/files/share/share.hpp"

namespace foretrack {
namespace {

using eprosima::fastrtps::rtps::PropertyPolicyHelper;

// Once a process: the middleware keeps the profiles of all its participants in one place.
void load_qos_profiles() {
  static std::once_flag once;
  std::call_once(once, [] {
    const std::string path = find_share("qos/profiles.xml");
    auto* factory = dds::DomainParticipantFactory::get_instance();
    if (factory->load_XML_profiles_file(path) != ReturnCode_t::RETCODE_OK)
      throw std::runtime_error("QoS profiles " + path + " cannot be read");
  });
}

// The profile's property foretrack.map_bytes_per_10ms, so that maps leave room on a radio link.
void add_map_limit(dds::DomainParticipantQos& qos) {
  const auto* text =
      PropertyPolicyHelper::find_property(qos.properties(), "foretrack.map_bytes_per_10ms");
  auto limit = std::make_shared<eprosima::fastdds::rtps::FlowControllerDescriptor>();
  limit->name = kMapFlow;
  limit->max_bytes_per_period = text ? std::stoi(*text) : 0;  // 0: no limit
  limit->period_ms = 10;
  qos.flow_controllers().push_back(limit);
}

// The option is heard, else the profile, else the loopback interface is taken.
std::vector<std::string> chosen_interfaces(const NodeOptions& options,
                                           const dds::TransportConfigQos& transport) {
  if (!options.interface.empty()) return find_interfaces(options.interface).addresses;
  if (names_interfaces(transport.user_transports)) return {};
  return find_interfaces(kLoopback).addresses;
}

bool reaches_nobody(const NodeOptions& options, const dds::TransportConfigQos& transport,
                    const Interfaces& chosen) {
  if (options.interface == kAnyInterface) return false;
  return chosen.addresses.empty() ? stay_on_this_machine(transport.user_transports)
                                  : chosen.this_machine_only();
}

void take_identity(dds::DomainParticipantQos& qos, const std::string& folder) {
  if (folder.empty()) return;
  if (const auto fault = fault_of_identity(folder); !fault.empty())
    throw std::invalid_argument("--security: " + fault);
  auto& properties = qos.properties().properties();
  for (const auto& [name, value] : identity_properties(folder)) {
    std::erase_if(properties, [&name = name](const auto& known) { return known.name() == name; });
    properties.emplace_back(name, value);
  }
}

}  // namespace

ParticipantSetup set_up_participant(const NodeOptions& options,
                                    std::shared_ptr<WireFilter> filter) {
  load_qos_profiles();
  ParticipantSetup setup{.qos = dds::PARTICIPANT_QOS_DEFAULT};  // GCC 12 warns of a new one
  auto* factory = dds::DomainParticipantFactory::get_instance();
  if (factory->get_participant_qos_from_profile("foretrack", setup.qos) != ReturnCode_t::RETCODE_OK)
    throw std::runtime_error("qos/profiles.xml has no participant profile 'foretrack'");
  add_map_limit(setup.qos);
  take_identity(setup.qos, options.security);
  auto& transport = setup.qos.transport();
  const Interfaces chosen{chosen_interfaces(options, transport)};
  setup.this_machine_only = reaches_nobody(options, transport, chosen);
  setup.secured =
      PropertyPolicyHelper::find_property(setup.qos.properties(), "dds.sec.auth.plugin") != nullptr;
  transport.user_transports = filtered_transports(
      transport, {std::move(filter), setup.this_machine_only, chosen.addresses});
  transport.use_builtin_transports = false;
  setup.qos.name((options.names.vehicle + '/' + options.service).c_str());
  return setup;
}

}  // namespace foretrack
