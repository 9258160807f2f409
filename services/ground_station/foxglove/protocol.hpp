// SPDX-License-Identifier: Apache-2.0
// The Foxglove WebSocket protocol, version 1: what is said, without a socket.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "services/ground_station/bus/channel.hpp"

namespace foretrack::station::foxglove {

/// The same messages under both names; the second is what newer Foxglove asks for.
inline constexpr std::array<std::string_view, 2> kSubprotocols = {"foxglove.websocket.v1",
                                                                  "foxglove.sdk.v1"};
/// The first of ours that the client's header lists; empty: none.
std::string_view choose_subprotocol(std::string_view header);

// ── what a client says ──
struct Subscribe {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> subscriptions;  // id, channel
};
struct Unsubscribe {
  std::vector<std::uint32_t> ids;
};
/// Whether it wants to be told who publishes and subscribes.
struct WantGraph {
  bool wanted = false;
};
/// Something of the protocol that this server does not offer.
struct NotOffered {
  std::string op;
};
struct Malformed {
  std::string why;
};
using ClientMessage = std::variant<Subscribe, Unsubscribe, WantGraph, NotOffered, Malformed>;

/// Never throws. The text may be anything.
ClientMessage parse_text(std::string_view text);
/// Clients may publish nothing here, so any binary message is refused.
ClientMessage parse_binary(std::span<const std::uint8_t> data);

// ── what the server says ──
enum class Level { kInfo = 0, kWarning = 1, kError = 2 };

std::string server_info(const std::string& name, const std::string& session_id,
                        const std::string& version);
std::string advertise(const std::vector<Channel>& channels);
std::string unadvertise(const std::vector<std::uint32_t>& channels);
/// Who publishes and who subscribes, by topic.
struct Ends {
  std::vector<std::string> publishers, subscribers;
  bool operator==(const Ends&) const = default;
};
using Graph = std::map<std::string, Ends>;
/// What changed between two graphs; empty: nothing.
std::string graph_update(const Graph& before, const Graph& now);

std::string status(Level level, const std::string& message);

/// Comes before a sample's bytes in a binary message.
inline constexpr std::size_t kMessageHeaderBytes = 13;
std::array<std::uint8_t, kMessageHeaderBytes> message_header(std::uint32_t subscription,
                                                             std::int64_t log_time_ns);

}  // namespace foretrack::station::foxglove
