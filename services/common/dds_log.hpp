// SPDX-License-Identifier: Apache-2.0
// What DDS logs, as lines of ours; and what it complained of last.
#pragma once

#include <functional>
#include <string>

namespace foretrack {

/// From now on its log goes where ours goes: errors as warnings, the rest for debugging.
void log_dds();

/// Why DDS-Security refused, as far as it told, in one line; empty: it said nothing. Since the last
/// call.
std::string security_complaint();

/// Calls back, from a thread of DDS, when it refuses a peer's writer or reader, since the peer's
/// role does not allow it: nobody else is told. It does not know whose participant refused.
class RoleWatch {
 public:
  using Callback = std::function<void(const std::string& text)>;
  explicit RoleWatch(Callback callback);
  ~RoleWatch();
  RoleWatch(const RoleWatch&) = delete;
  RoleWatch& operator=(const RoleWatch&) = delete;

 private:
  Callback callback_;
};

}  // namespace foretrack
