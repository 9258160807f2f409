// SPDX-License-Identifier: Apache-2.0
// What is to be said of identities before somebody flies with them.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace foretrack::security {

struct Inspection {
  std::filesystem::path folder;
  std::string name{};      // "/uav1/gate", as its certificate says
  double days_left = 0.0;  // negative: it is over
  std::string fault{};     // a process with it is refused; empty: none
  std::string advice{};    // it works, and something is to be done; may be empty
};

/// Of a keystore all identities and the authorities' keys, of a folder of identities each, of an
/// identity itself. Empty: there is none.
std::vector<Inspection> inspect(const std::filesystem::path& folder);

}  // namespace foretrack::security
