// SPDX-License-Identifier: Apache-2.0
// What discovery, liveliness and the security handshake carry, each in its own form.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "services/common/wire/wire_reader.hpp"

namespace foretrack::wire {

/// Which form the samples of a built-in writer or reader have.
enum class Form { kFree, kParameters, kSignOfLife, kHandshake };
Form form_of(std::uint32_t entity_id);

/// Where a parameter is that is to be blanked.
class Blanks {
 public:
  virtual ~Blanks() = default;
  virtual void add(std::size_t position) = 0;
};

/// Parameters up to the sentinel, from where the reader stands; false: they do not fit. The reader
/// stands behind them afterwards.
bool check_parameters(Reader& reader, Blanks& blanks);

/// The built-in writer by which a participant tells of itself.
inline constexpr std::uint32_t kParticipantWriter = 0x000100c2;
/// Whether these parameters, which fit, name an identity of DDS-Security.
bool has_identity(std::span<const std::uint8_t> payload);

/// A sample with its encapsulation. Positions of blanks are from the payload's beginning.
bool check_payload(Form form, std::span<const std::uint8_t> payload, Blanks& blanks);

}  // namespace foretrack::wire
