// SPDX-License-Identifier: Apache-2.0
// Who a participant is to DDS-Security: a folder as SROS2 makes it for an enclave.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace foretrack {

/// The files of an identity, by the names that SROS2 gives them.
namespace identity_file {
inline constexpr char kAuthority[] = "identity_ca.cert.pem";
inline constexpr char kCertificate[] = "cert.pem";
inline constexpr char kKey[] = "key.pem";
inline constexpr char kPermissionsAuthority[] = "permissions_ca.cert.pem";
inline constexpr char kGovernance[] = "governance.p7s";
inline constexpr char kPermissions[] = "permissions.p7s";
inline constexpr char kRevocations[] = "crl.pem";  // the only one that may be missing
}  // namespace identity_file

/// Of a folder of identities, as `foretrack security issue` makes it for a vehicle, the one of a
/// process by its service's name ("safety_gate"); of an identity, itself. Throws
/// std::invalid_argument if there is none, and names those there are.
std::string identity_folder(const std::string& folder, std::string_view service);

/// What is wrong with the folder, in one line: a file that is missing, cannot be read or lets
/// others read the key, a certificate that is over, not yet valid, revoked or of another authority,
/// a key that is not the certificate's; empty: nothing that can be seen before DDS looks at it.
std::string fault_of_identity(const std::string& folder);

/// Why DDS may have refused it, after it did: it tells nobody. Signed by another authority, no
/// grant for the certificate's subject, or whatever else there is.
std::string refusal_of_identity(const std::string& folder);

/// A sentence if the identity ends within a month, when a process that has to be started again
/// will not come back; else, or without a folder, empty.
std::string soon_over(const std::string& folder);

/// Whether its governance keeps out who has no identity at all.
bool demands_identity(const std::string& folder);

/// The properties of a participant that make it so.
std::vector<std::pair<std::string, std::string>> identity_properties(const std::string& folder);

}  // namespace foretrack
