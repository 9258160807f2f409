// SPDX-License-Identifier: Apache-2.0
// What DDS-Security enforces, as the documents that its specification names: the governance of a
// domain, and the permissions of a role. Who may write what is read from the table of topics.
#pragma once

#include <ctime>
#include <string>
#include <vector>

#include "services/common/names.hpp"
#include "services/common/roles.hpp"

namespace foretrack::security {

/// Of the vehicle's name in Names: an identity for all vehicles.
inline constexpr char kAllVehicles[] = "*";

struct Validity {
  std::time_t from = 0, until = 0;
};

struct Grant {
  std::string subject;  // of the certificate: "CN=/uav1/gate"
  Role role;
  Names names;         // of the vehicle
  Validity validity;   // of the certificate
  int domain_id = -1;  // -1: any
};

/// Names on the wire, with * for any text, that the role may write on the vehicle's bus.
std::vector<std::string> writable_topics(Role role, const Names& names);

/// Nobody takes part without an identity, every message is signed, all but the first words of
/// discovery are encrypted, and no reader can speak in the name of a writer.
std::string governance_text();
/// Reads all, writes what its role may write.
std::string permissions_text(const Grant& grant);

}  // namespace foretrack::security
