// SPDX-License-Identifier: Apache-2.0
#include "services/common/rendezvous.hpp"

#include <arpa/inet.h>
#include <fmt/format.h>
#include <netdb.h>
#include <sys/socket.h>
#include <unistd.h>

#include <charconv>
#include <cstdlib>
#include <memory>
#include <stdexcept>
#include <string_view>

namespace foretrack {
namespace {

constexpr std::uint16_t kAnyPort = 9;  // nothing is sent

std::string text_of(const sockaddr_in& address) {
  char text[INET_ADDRSTRLEN] = "";
  inet_ntop(AF_INET, &address.sin_addr, text, sizeof text);
  return text;
}

std::string resolve(const std::string& host) {
  addrinfo hints{}, *found = nullptr;
  hints.ai_family = AF_INET;
  if (getaddrinfo(host.c_str(), nullptr, &hints, &found) != 0 || !found)
    throw std::invalid_argument(
        fmt::format("'{}' is no IPv4 address, and no name of a machine that is known here", host));
  const std::unique_ptr<addrinfo, decltype(&freeaddrinfo)> owner(found, freeaddrinfo);
  return text_of(*reinterpret_cast<const sockaddr_in*>(found->ai_addr));
}

}  // namespace

MeetingPoint find_meeting_point(const std::string& text) {
  const auto colon = text.find(':');
  MeetingPoint result;
  if (colon != std::string::npos) {
    const char* end = text.data() + text.size();
    const auto [rest, error] = std::from_chars(text.data() + colon + 1, end, result.port);
    if (error != std::errc() || rest != end || result.port == 0)
      throw std::invalid_argument(
          fmt::format("'{}': HOST or HOST:PORT is expected, a port of 1 to 65535", text));
  }
  result.address = resolve(text.substr(0, colon));
  return result;
}

std::string address_towards(const MeetingPoint& point) {
  sockaddr_in there{}, here{};
  there.sin_family = AF_INET;
  there.sin_port = htons(point.port != 0 ? point.port : kAnyPort);
  inet_pton(AF_INET, point.address.c_str(), &there.sin_addr);
  const int probe = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  socklen_t size = sizeof here;
  const bool found = probe >= 0 &&
                     connect(probe, reinterpret_cast<sockaddr*>(&there), sizeof there) == 0 &&
                     getsockname(probe, reinterpret_cast<sockaddr*>(&here), &size) == 0;
  if (probe >= 0) close(probe);
  if (!found)
    throw std::invalid_argument(
        fmt::format("no network of this machine leads to {}", point.address));
  return text_of(here);
}

DiscoveryRange discovery_range() {
  const char* value = std::getenv("ROS_AUTOMATIC_DISCOVERY_RANGE");
  const std::string_view text = value ? value : "";
  if (text.empty() || text == "SYSTEM_DEFAULT") return DiscoveryRange::kDefault;
  if (text == "OFF") return DiscoveryRange::kNobody;
  if (text == "LOCALHOST") return DiscoveryRange::kThisMachine;
  if (text == "SUBNET") return DiscoveryRange::kSubnet;
  throw std::invalid_argument(fmt::format(
      "ROS_AUTOMATIC_DISCOVERY_RANGE is '{}'; OFF, LOCALHOST, SUBNET or SYSTEM_DEFAULT is expected",
      text));
}

}  // namespace foretrack
