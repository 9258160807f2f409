// SPDX-License-Identifier: Apache-2.0
// A keystore that goes with its owner.
#pragma once

#include <ctime>
#include <string>

#include "services/common/identity.hpp"
#include "services/security/keystore.hpp"
#include "tests/support/folder.hpp"

namespace foretrack {

inline constexpr std::time_t kTestDay_s = 86400;

inline security::Validity valid_days(int from, int until) {
  const std::time_t now = std::time(nullptr);
  return {now + from * kTestDay_s, now + until * kTestDay_s};
}

struct Keys {
  explicit Keys(bool of_simulation = false)
      : store(security::Keystore::create(folder.path / "keys", of_simulation, valid_days(-1, 10))) {
  }
  /// The folder of a new identity of vehicle uav1.
  std::string issue(Role role, const std::string& person = "",
                    security::Validity validity = valid_days(-1, 9)) {
    return store.issue({.names = {}, .role = role, .person = person}, validity);
  }

  testing::Folder folder;
  security::Keystore store;
};

}  // namespace foretrack
