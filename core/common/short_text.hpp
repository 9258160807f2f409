// SPDX-License-Identifier: Apache-2.0
// A short text that needs no heap: names of operators and leases.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <string_view>

namespace foretrack {

/// At most 64 bytes, as the IDL bounds it; what is longer is cut. Trivially copyable.
struct ShortText {
  static constexpr std::size_t kCapacity = 64;

  std::array<char, kCapacity> bytes{};
  std::uint8_t length = 0;

  constexpr ShortText() = default;
  constexpr ShortText(std::string_view text)  // NOLINT: a text is one
      : length(static_cast<std::uint8_t>(std::min(text.size(), kCapacity))) {
    std::copy_n(text.data(), length, bytes.data());
  }
  constexpr ShortText(const char* text) : ShortText(std::string_view(text)) {}
  ShortText(const std::string& text) : ShortText(std::string_view(text)) {}

  constexpr std::string_view view() const { return {bytes.data(), length}; }
  constexpr bool empty() const { return length == 0; }
  bool operator==(const ShortText&) const = default;
};

}  // namespace foretrack
