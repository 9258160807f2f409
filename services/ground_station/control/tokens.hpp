// SPDX-License-Identifier: Apache-2.0
// The secrets by which operators are known.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace foretrack::station {

/// A file with a line `operator token` each; the operator `*` stands for any name.
class Tokens {
 public:
  /// Makes the file with one random token of 256 bits for `*`, mode 0600, if it is not there.
  /// Throws std::runtime_error if others may read it, or if a line is malformed or a token short.
  static Tokens load_or_create(const std::filesystem::path& path);

  /// Whose token it is; none: nobody's. Compares with all of them, each in constant time.
  std::optional<std::string> owner(std::string_view token) const;
  /// Whether the token's owner may act under this operator's name.
  bool may_act_as(std::string_view token, std::string_view operator_name) const;
  /// The first one, for the address that is printed.
  const std::string& first() const { return tokens_.front().second; }

 private:
  std::vector<std::pair<std::string, std::string>> tokens_;
};

/// So many random bytes as hexadecimal digits.
std::string random_hex(int bytes);

}  // namespace foretrack::station
