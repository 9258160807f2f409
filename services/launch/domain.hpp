// SPDX-License-Identifier: Apache-2.0
// DDS domains that nobody else on this machine uses.
#pragma once

namespace foretrack {

/// A domain held for this process: two flights at once must not hear each other.
class FreeDomain {
 public:
  /// Throws std::runtime_error if all are taken.
  FreeDomain();
  ~FreeDomain();
  FreeDomain(const FreeDomain&) = delete;
  FreeDomain& operator=(const FreeDomain&) = delete;
  int id() const { return id_; }

 private:
  int id_ = -1;
  int claim_ = -1;
};

/// Whether a process on this machine listens on the domain's ports (RTPS: 7400 + 250 * domain).
bool domain_is_in_use(int domain);

}  // namespace foretrack
