// SPDX-License-Identifier: Apache-2.0
#include "services/ground_station/bus/hearing.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace foretrack::station {
namespace {

constexpr double kGap_s = 2.0;     // health comes once a second
constexpr double kSteady_s = 5.0;  // after which silence means something
constexpr double kSlack_s = 2.0;   // for discovery to drop whose lease is over
constexpr double kReturn_s = 5.0;  // in which one that came back is heard, if all is well
constexpr double kForget_s = 600.0;

}  // namespace

void Hearing::heard(const PeerId& from, double now_s) {
  const auto [it, is_new] = voices_.try_emplace(from, Voice{now_s, now_s});
  auto& voice = it->second;
  if (now_s - voice.last_s > kGap_s) voice.steady_since_s = now_s;
  voice.last_s = now_s;
}

std::string Hearing::complaint(const std::vector<Peer>& peers, double now_s) {
  std::erase_if(voices_, [&](const auto& v) { return now_s - v.second.last_s > kForget_s; });
  for (const auto& peer : peers) {
    const auto it = voices_.find(peer.id);
    if (it == voices_.end()) continue;
    const auto& [steady_since_s, last_s] = it->second;
    if (last_s - steady_since_s < kSteady_s) continue;
    const bool is_back = peer.since_s > last_s;
    const double silent_s = now_s - std::max(last_s, peer.since_s);
    if (silent_s > (is_back ? kReturn_s : peer.lease_s + kSlack_s))
      return fmt::format("{} {}, but nothing was heard of it for {:.1f} s", peer.name,
                         is_back ? "is back" : "lives", now_s - last_s);
  }
  return {};
}

}  // namespace foretrack::station
