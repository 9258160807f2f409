// SPDX-License-Identifier: Apache-2.0
#include "services/ground_station/http/guard.hpp"

#include <openssl/crypto.h>

namespace foretrack::station {

std::string refusal_of_host(const GuardOptions& options, const Request& request) {
  if (options.hosts.contains(request.host)) return {};
  return "this station does not go by the name in Host";
}

std::string refusal_of_origin(const GuardOptions& options, const Request& request) {
  if (request.origin.empty() || options.origins.contains(request.origin)) return {};
  return "pages of this Origin may not use this station";
}

std::string token_of(const Request& request) {
  constexpr std::string_view kBearer = "Bearer ";
  constexpr std::string_view kKey = "token=";
  if (request.authorization.starts_with(kBearer))
    return request.authorization.substr(kBearer.size());
  std::string_view rest = request.query;
  while (!rest.empty()) {
    const auto end = rest.find('&');
    const auto pair = rest.substr(0, end);
    if (pair.starts_with(kKey)) return std::string(pair.substr(kKey.size()));
    if (end == std::string_view::npos) break;
    rest.remove_prefix(end + 1);
  }
  return {};
}

bool same_secret(std::string_view a, std::string_view b) {
  return a.size() == b.size() && CRYPTO_memcmp(a.data(), b.data(), a.size()) == 0;
}

}  // namespace foretrack::station
