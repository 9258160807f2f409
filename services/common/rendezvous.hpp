// SPDX-License-Identifier: Apache-2.0
// Where participants meet: by multicast, at addresses that are named, or at a discovery server.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace foretrack {

struct MeetingPoint {
  std::string address;     // IPv4
  std::uint16_t port = 0;  // 0: of every participant of the domain there
};

/// Of "HOST" or "HOST:PORT". Throws std::invalid_argument if it is neither, or not known.
MeetingPoint find_meeting_point(const std::string& text);

/// This machine's address on the way there: what DDS must use to be heard by it. Throws
/// std::invalid_argument if there is no way.
std::string address_towards(const MeetingPoint& point);

/// How far ROS_AUTOMATIC_DISCOVERY_RANGE lets discovery reach; kDefault: as our own options say.
enum class DiscoveryRange { kDefault, kNobody, kThisMachine, kSubnet };
/// Throws std::invalid_argument on a value that ROS 2 does not have.
DiscoveryRange discovery_range();

}  // namespace foretrack
