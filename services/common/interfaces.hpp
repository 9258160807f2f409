// SPDX-License-Identifier: Apache-2.0
// Which network interfaces DDS uses: this machine's own unless others are named.
#pragma once

#include <string>
#include <vector>

namespace foretrack {

/// What --interface says; empty: what the profile says, else the loopback interface.
inline constexpr char kLoopback[] = "lo";
inline constexpr char kLoopbackAddress[] = "127.0.0.1";
inline constexpr char kAnyInterface[] = "any";

struct Interfaces {
  /// IPv4 addresses to use, the loopback one always among them; empty: all there are.
  std::vector<std::string> addresses;
  /// Nobody else can be heard, and nobody else hears us.
  bool this_machine_only() const;
};

/// By "any", an interface's name or one of its addresses. Throws std::invalid_argument if there is
/// none, and names those there are.
Interfaces find_interfaces(const std::string& name_or_address);

/// "eth0 (192.0.2.2)", of all that are up.
std::vector<std::string> interfaces_here();

}  // namespace foretrack
