// SPDX-License-Identifier: Apache-2.0
// The participant of a node, as qos/profiles.xml and the node's options have it. Only .cpp files of
// this folder include it.
#pragma once

#include <fastdds/dds/domain/qos/DomainParticipantQos.hpp>
#include <memory>

#include "services/common/node.hpp"

namespace foretrack {

struct ParticipantSetup {
  eprosima::fastdds::dds::DomainParticipantQos qos;
  bool this_machine_only = false;  // no interface of others is used
  bool secured = false;            // the profile has DDS-Security
};

/// Every transport of it is behind the filter. Throws std::runtime_error if the profiles cannot be
/// read or lack ours, std::invalid_argument if there is no such interface or the identity is no
/// good.
ParticipantSetup set_up_participant(const NodeOptions& options, std::shared_ptr<WireFilter> filter);

}  // namespace foretrack
