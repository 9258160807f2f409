// SPDX-License-Identifier: Apache-2.0
// Which version of a type a peer speaks: what writers and readers tell of themselves in discovery
// (USER_DATA), as ROS 2 does from Iron on: "typehash=RIHS01_…;", and our version behind it.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace foretrack {

/// "RIHS01_…" of a type as named on the wire; empty: it is not in idl/.
std::string_view type_hash_of(std::string_view wire_type);

/// What an endpoint of that type tells. Empty for types that are not in idl/.
std::vector<std::uint8_t> told_of_type(std::string_view wire_type);

/// What a peer told; empty: nothing.
struct ToldOfType {
  std::string hash, version;  // the version is that of foretrack
};
ToldOfType read_told(const std::vector<std::uint8_t>& user_data);

/// A phrase if a peer's type has our name and another layout, so that what it sends is misread;
/// else empty. Whoever does not tell is believed.
std::string other_version(std::string_view wire_type, const ToldOfType& told);

}  // namespace foretrack
