// SPDX-License-Identifier: Apache-2.0
#include "services/common/interfaces.hpp"

#include <arpa/inet.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <ifaddrs.h>
#include <net/if.h>

#include <algorithm>
#include <memory>
#include <stdexcept>

namespace foretrack {
namespace {

struct Interface {
  std::string name, address;
};

std::vector<Interface> all_interfaces() {
  ifaddrs* first = nullptr;
  if (getifaddrs(&first) != 0) return {};
  const std::unique_ptr<ifaddrs, decltype(&freeifaddrs)> owner(first, freeifaddrs);
  std::vector<Interface> result;
  for (const auto* i = first; i; i = i->ifa_next) {
    if (!i->ifa_addr || i->ifa_addr->sa_family != AF_INET || !(i->ifa_flags & IFF_UP)) continue;
    char text[INET_ADDRSTRLEN] = "";
    const auto* address = reinterpret_cast<const sockaddr_in*>(i->ifa_addr);
    inet_ntop(AF_INET, &address->sin_addr, text, sizeof text);
    result.push_back({i->ifa_name, text});
  }
  return result;
}

}  // namespace

bool Interfaces::this_machine_only() const {
  return !addresses.empty() && std::all_of(addresses.begin(), addresses.end(),
                                           [](const auto& a) { return a.starts_with("127."); });
}

std::vector<std::string> interfaces_here() {
  std::vector<std::string> result;
  for (const auto& [name, address] : all_interfaces())
    result.push_back(fmt::format("{} ({})", name, address));
  return result;
}

Interfaces find_interfaces(const std::string& name_or_address) {
  if (name_or_address == kAnyInterface) return {};
  Interfaces result{{kLoopbackAddress}};
  if (name_or_address == kLoopback || name_or_address == kLoopbackAddress) return result;
  for (const auto& [name, address] : all_interfaces())
    if (name == name_or_address || address == name_or_address) result.addresses.push_back(address);
  if (result.addresses.size() == 1)
    throw std::invalid_argument(fmt::format(
        "there is no network interface '{}' with an IPv4 address; there are {}, and 'any'",
        name_or_address, fmt::join(interfaces_here(), ", ")));
  return result;
}

}  // namespace foretrack
