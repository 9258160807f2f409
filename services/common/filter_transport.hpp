// SPDX-License-Identifier: Apache-2.0
// A transport that judges every message before the library reads it. Only .cpp files of this folder
// include it.
#pragma once

#include <fastdds/dds/domain/qos/DomainParticipantQos.hpp>
#include <memory>
#include <string>
#include <vector>

#include "services/common/wire_filter.hpp"

namespace foretrack {

using Transports =
    std::vector<std::shared_ptr<eprosima::fastdds::rtps::TransportDescriptorInterface>>;

/// What messages go through, and whether others than this machine may send them.
struct Entrance {
  std::shared_ptr<WireFilter> filter;
  bool this_machine_only = false;
  /// Instead of the transports' own, unless it is empty; they have to be of IPv4 then.
  std::vector<std::string> interfaces;
};

/// Whether a transport of the profile names its interfaces itself.
bool names_interfaces(const Transports& transports);
/// Whether none of them reaches beyond this machine, by the interfaces that they name.
bool stay_on_this_machine(const Transports& transports);

/// All transports of a participant behind the entrance, those that the library would add by itself
/// among them. Throws std::runtime_error on a kind that is not known, so that none is left open.
Transports filtered_transports(const eprosima::fastdds::dds::TransportConfigQos& transport,
                               const Entrance& entrance);

}  // namespace foretrack
