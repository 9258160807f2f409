// SPDX-License-Identifier: Apache-2.0
// A fuzzer for compilers without one: seeded mutations of a good input.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "core/common/random.hpp"

namespace foretrack::testing {

class Mutator {
 public:
  explicit Mutator(std::uint64_t seed) : random_(seed) {}

  /// One to four changes: bits, bytes, 16- and 32-bit numbers at the edge of something, cuts,
  /// copies of other places.
  std::vector<std::uint8_t> mutate(const std::vector<std::uint8_t>& good) {
    std::vector<std::uint8_t> bytes = good;
    const int changes = random_.integer(1, 4);
    for (int k = 0; k < changes && !bytes.empty(); ++k) change(bytes);
    return bytes;
  }

 private:
  std::size_t place(const std::vector<std::uint8_t>& bytes) {
    return static_cast<std::size_t>(random_.integer(0, static_cast<int>(bytes.size()) - 1));
  }
  void change(std::vector<std::uint8_t>& bytes) {
    constexpr std::array<std::uint32_t, 9> edges = {0,      1,      2,          0x7f,      0xff,
                                                    0x7fff, 0xffff, 0x7fffffff, 0xffffffff};
    const std::size_t at = place(bytes);
    const int kind = random_.integer(0, 5);
    if (kind == 0) bytes[at] ^= static_cast<std::uint8_t>(1 << random_.integer(0, 7));
    if (kind == 1) bytes[at] = static_cast<std::uint8_t>(random_.integer(0, 255));
    if (kind == 2 || kind == 3) {
      const std::uint32_t edge = edges[static_cast<std::size_t>(random_.integer(0, 8))];
      for (std::size_t k = 0; k < (kind == 2 ? 2u : 4u) && at + k < bytes.size(); ++k)
        bytes[at + k] = static_cast<std::uint8_t>(edge >> (8 * k));
    }
    if (kind == 4) bytes.resize(at);
    if (kind == 5) {
      const std::size_t from = place(bytes);
      const std::size_t count = std::min({std::size_t{8}, bytes.size() - from, bytes.size() - at});
      const auto first = bytes.begin() + static_cast<std::ptrdiff_t>(from);
      const std::vector<std::uint8_t> copied(first, first + static_cast<std::ptrdiff_t>(count));
      std::copy(copied.begin(), copied.end(), bytes.begin() + static_cast<std::ptrdiff_t>(at));
    }
  }
  Random random_;
};

}  // namespace foretrack::testing
