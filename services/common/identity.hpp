// SPDX-License-Identifier: Apache-2.0
// Who a participant is to DDS-Security: a folder as SROS2 makes it for an enclave.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace foretrack {

/// What is wrong with the folder, in one line: a file that is missing or cannot be read, a
/// certificate that is over, not yet valid, or of another authority, a key that is not the
/// certificate's; empty: nothing that can be seen before DDS looks at it.
std::string fault_of_identity(const std::string& folder);

/// Why DDS may have refused it, after it did: it tells nobody. Signed by another authority, no
/// grant for the certificate's subject, or whatever else there is.
std::string refusal_of_identity(const std::string& folder);

/// The properties of a participant that make it so.
std::vector<std::pair<std::string, std::string>> identity_properties(const std::string& folder);

}  // namespace foretrack
