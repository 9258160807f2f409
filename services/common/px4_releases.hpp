// SPDX-License-Identifier: Apache-2.0
// PX4's messages by release: version, name on the wire, layout of the bytes. Types keep their name
// when their fields change, and topics get a suffix only for some of them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace foretrack {

/// Those that are known, oldest first.
inline constexpr std::string_view kPx4Releases[] = {"1.15", "1.16", "1.17", "1.18"};
/// Whose messages idl/px4_msgs has.
inline constexpr std::string_view kPx4ReleaseOfIdl = "1.16";

/// Throws std::invalid_argument that names those that are known.
void check_px4_release(std::string_view release);

/// The version of the topic's message: "vehicle_status" → 1 in 1.16; 0 of what is not known.
/// Precondition: the release is known.
int px4_version(std::string_view topic, std::string_view release);

/// The release that names its topics so ("rt/fmu/out/vehicle_status_v4", …); of several the newest;
/// empty: none does. `px4_namespace` is as in Names.
std::string_view px4_release_of(std::span<const std::string> wire_names,
                                std::string_view px4_namespace);

/// The fields of a message, each with its place in the bytes (XCDR1, without the header).
struct Px4Layout {
  struct Field {
    std::string_view name;
    std::size_t at, bytes;
  };
  std::vector<Field> fields;
  std::size_t bytes = 0;
};

/// None (no fields) for what is no message of PX4's, by the type's name on the wire.
Px4Layout px4_layout_of(std::string_view type, std::string_view release);

/// Every field of `to` that `from` has, at its place; the others are 0. Precondition: `in` is as
/// long as `from`. `out` is as long as `to` afterwards.
void rearrange(const Px4Layout& from, std::span<const std::uint8_t> in, const Px4Layout& to,
               std::vector<std::uint8_t>& out);

}  // namespace foretrack
