// SPDX-License-Identifier: Apache-2.0
// Who may talk to the station: exact host names, exact origins, the token.
#pragma once

#include <set>
#include <string>
#include <string_view>

#include "services/ground_station/http/message.hpp"

namespace foretrack::station {

struct GuardOptions {
  std::set<std::string> hosts;    // allowed in Host: "127.0.0.1:8080"; a name that resolves
                                  // to us but is not here is a rebinding attack
  std::set<std::string> origins;  // allowed in Origin: "http://127.0.0.1:8080"
  bool token_to_read = false;
};

/// Empty: allowed. Else why not.
std::string refusal_of_host(const GuardOptions& options, const Request& request);
/// Programs send no Origin and are allowed; pages must be of an allowed one.
std::string refusal_of_origin(const GuardOptions& options, const Request& request);

/// From `Authorization: Bearer …` or, for WebSockets of browsers, which cannot set it, from the
/// query's `token=…`. Empty: none was sent.
std::string token_of(const Request& request);

/// In constant time.
bool same_secret(std::string_view a, std::string_view b);

}  // namespace foretrack::station
