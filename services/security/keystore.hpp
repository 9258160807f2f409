// SPDX-License-Identifier: Apache-2.0
// A folder of keys as SROS2 lays it out: private/ (the authorities' keys, which stay at home),
// public/ (their certificates, the revocations) and enclaves/<vehicle>/<role>/ (identities, each
// complete: a folder to be copied to where its process runs).
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "services/security/authority.hpp"

namespace foretrack::security {

/// Whom an identity is for.
struct Identity {
  Names names;  // of the vehicle, or kAllVehicles
  Role role{};
  std::string person;  // told apart from others of the role: "ada"; may be empty
  int domain_id = -1;  // -1: any
};
/// "uav1/gate", "uav1/operator-ada", "fleet/viewer": its folder in enclaves/, and, after a slash,
/// the name in its certificate.
std::string enclave_of(const Identity& identity);

/// Not for two processes at a time. Functions throw std::invalid_argument on what a user must
/// correct, std::runtime_error if a file cannot be written.
class Keystore {
 public:
  /// Makes the authorities: one for identities, one for permissions. A keystore of simulations is
  /// another one, so that nobody of it is heard by a real vehicle. The folder must not hold one
  /// yet.
  static Keystore create(const std::filesystem::path& folder, bool of_simulation,
                         const Validity& validity);
  /// Opens it.
  explicit Keystore(const std::filesystem::path& folder);

  const std::filesystem::path& folder() const { return folder_; }
  bool of_simulation() const { return of_simulation_; }

  /// Makes the identity's folder, or renews what is in it: its former certificates stay good until
  /// they end or are revoked, so that who runs with one goes on. Returns the folder.
  std::filesystem::path issue(const Identity& identity, Validity validity);
  /// Of all certificates that were ever issued to the enclave ("uav1/operator"), or,
  /// `all_but_last`, of those that were replaced. Returns how many were revoked now.
  int revoke(const std::string& enclave, bool all_but_last);
  /// "uav1/gate", sorted.
  std::vector<std::string> enclaves() const;
  std::filesystem::path folder_of(const std::string& enclave) const;

 private:
  Keystore(const std::filesystem::path& folder, Authority identities, Authority permissions);
  void write_revocations(const RevocationList& list);
  std::vector<Certificate> issued_to(const std::string& enclave) const;

  std::filesystem::path folder_;
  bool of_simulation_ = false;
  Authority identities_, permissions_;
};

/// Whether the folder holds a keystore.
bool is_keystore(const std::filesystem::path& folder);

}  // namespace foretrack::security
