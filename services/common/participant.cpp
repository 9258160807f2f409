// SPDX-License-Identifier: Apache-2.0
#include "services/common/participant.hpp"

#include <fastdds/rtps/attributes/ServerAttributes.h>
#include <fastrtps/utils/IPLocator.h>

#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <mutex>
#include <set>
#include <stdexcept>

#include "services/common/dds_impl.hpp"
#include "services/common/filter_transport.hpp"
#include "services/common/identity.hpp"
#include "services/common/interfaces.hpp"
#include "services/common/rendezvous.hpp"
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

// Of this machine, towards all that are named; none: nobody is.
std::vector<std::string> addresses_towards(const std::vector<MeetingPoint>& points) {
  std::set<std::string> result;
  for (const auto& point : points) result.insert(address_towards(point));
  if (!result.empty()) result.insert(kLoopbackAddress);
  return {result.begin(), result.end()};
}

// The option is heard, else what leads to those that are named, else the profile, else ROS 2's
// variable, else the loopback interface is taken.
std::vector<std::string> chosen_interfaces(const NodeOptions& options,
                                           const dds::TransportConfigQos& transport,
                                           const std::vector<MeetingPoint>& points) {
  if (!options.interface.empty()) return find_interfaces(options.interface).addresses;
  if (!points.empty()) return addresses_towards(points);
  if (names_interfaces(transport.user_transports)) return {};
  if (discovery_range() == DiscoveryRange::kSubnet) return {};
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

namespace rtps = eprosima::fastrtps::rtps;
using Locator = rtps::Locator_t;

Locator locator_of(const std::string& address, std::uint32_t port) {
  Locator locator;
  rtps::IPLocator::createLocator(LOCATOR_KIND_UDPv4, address, port, locator);
  return locator;
}

// Beside those that are named, this machine and who hears multicast are told of us.
std::vector<MeetingPoint> meet_peers(rtps::BuiltinAttributes& builtin, const NodeOptions& options) {
  std::vector<MeetingPoint> points;
  for (const auto& peer : options.peers) points.push_back(find_meeting_point(peer));
  if (points.empty()) return points;
  const std::uint32_t domain_port =
      rtps::PortParameters().getMulticastPort(static_cast<std::uint32_t>(options.domain_id));
  builtin.initialPeersList.push_back(locator_of("239.255.0.1", domain_port));
  builtin.initialPeersList.push_back(locator_of(kLoopbackAddress, 0));
  for (const auto& point : points)
    builtin.initialPeersList.push_back(locator_of(point.address, point.port));
  return points;
}

// As one that is told of all, also of what it has no part in: the station lists it.
std::vector<MeetingPoint> meet_at_server(rtps::BuiltinAttributes& builtin,
                                         const NodeOptions& options) {
  if (!options.security.empty())
    throw std::invalid_argument(
        "--discovery-server and --security: Fast DDS 2.9 cannot do both; --peer HOST can");
  auto& discovery = builtin.discovery_config;
  discovery.discoveryProtocol = rtps::DiscoveryProtocol_t::SUPER_CLIENT;
  if (!rtps::load_environment_server_info(options.discovery_server, discovery.m_DiscoveryServers))
    throw std::invalid_argument("--discovery-server '" + options.discovery_server +
                                "': HOST:PORT is expected, of a machine that is known here");
  std::vector<MeetingPoint> points;
  for (const auto& server : discovery.m_DiscoveryServers)
    for (const Locator& locator : server.metatrafficUnicastLocatorList)
      points.push_back(
          {rtps::IPLocator::ip_to_string(locator), rtps::IPLocator::getPhysicalPort(locator)});
  return points;
}

// As the first of a list of servers, by which clients know it.
std::vector<MeetingPoint> be_server(eprosima::fastdds::dds::WireProtocolConfigQos& wire,
                                    const NodeOptions& options) {
  wire.builtin.discovery_config.discoveryProtocol = rtps::DiscoveryProtocol_t::SERVER;
  rtps::get_server_client_default_guidPrefix(0, wire.prefix);
  wire.builtin.metatrafficUnicastLocatorList.push_back(
      locator_of("0.0.0.0", static_cast<std::uint32_t>(options.serve_discovery_port)));
  return {};
}

// Where others are that are named.
std::vector<MeetingPoint> meet_others(dds::DomainParticipantQos& qos, const NodeOptions& options) {
  auto& builtin = qos.wire_protocol().builtin;
  if (options.serve_discovery_port > 0) return be_server(qos.wire_protocol(), options);
  if (discovery_range() == DiscoveryRange::kNobody) {
    builtin.discovery_config.discoveryProtocol = rtps::DiscoveryProtocol_t::NONE;
    return {};
  }
  if (!options.discovery_server.empty()) return meet_at_server(builtin, options);
  return meet_peers(builtin, options);
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
  const auto points = meet_others(setup.qos, options);
  take_identity(setup.qos, options.security);
  auto& transport = setup.qos.transport();
  const Interfaces chosen{chosen_interfaces(options, transport, points)};
  setup.this_machine_only = reaches_nobody(options, transport, chosen);
  setup.secured =
      PropertyPolicyHelper::find_property(setup.qos.properties(), "dds.sec.auth.plugin") != nullptr;
  if (!options.security.empty() && demands_identity(options.security)) filter->demand_identity();
  transport.user_transports = filtered_transports(
      transport, {std::move(filter), setup.this_machine_only, chosen.addresses});
  transport.use_builtin_transports = false;
  setup.qos.name((options.names.vehicle + '/' + options.service).c_str());
  return setup;
}

}  // namespace foretrack
