// SPDX-License-Identifier: Apache-2.0
// One client's side of the protocol, without its socket.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "services/common/rate.hpp"
#include "services/ground_station/foxglove/protocol.hpp"
#include "services/ground_station/hub/light_picture.hpp"
#include "services/ground_station/hub/outbox.hpp"

namespace foretrack::station {

struct HubLimits {
  std::size_t client_budget_bytes = 8u << 20;
  double topic_bytes_s = 8e6;        // of one topic to all clients; more is left out
  std::size_t subscriptions = 1024;  // of one client
  double silent_s = 10.0;            // a client that takes nothing for so long is closed
  double messages_s = 100.0;         // that a client may send
};

/// What the hub needs of a connection. Calls come in the hub's thread and must not block.
struct Link {
  std::function<void()> wake;                            // there is something to send
  std::function<void(const std::string& reason)> close;  // after which the client leaves
};

struct ClientReport {
  std::uint64_t id = 0;
  std::string address;
  std::size_t subscriptions = 0;
  bool watches = false;  // reads more than pictures, for which a page has a connection of their own
  std::size_t waiting_bytes = 0;
  std::uint64_t sent_bytes = 0;
  std::uint64_t dropped = 0;
  double bytes_s = 0.0;
};

class Hub;

/// Belongs to the hub's thread, and to the hub.
class Client {
 public:
  Client(Hub& hub, std::uint64_t id, std::string address, Link link, const HubLimits& limits);

  void on_text(std::string_view text, double now_s);
  void on_binary(std::span<const std::uint8_t> data, double now_s);
  /// What to send next; none: nothing waits. Call it again when that is sent.
  std::optional<Frame> next(double now_s);

 private:
  friend class Hub;
  void handle(const foxglove::ClientMessage& message, double now_s);
  void subscribe(const foxglove::Subscribe& wanted, double now_s);
  bool may_speak(double now_s);
  void tell(std::shared_ptr<const std::string> text);
  void tell(std::string text) { tell(std::make_shared<const std::string>(std::move(text))); }
  void offer(PerLink& sample, double now_s);
  void flush();  // after samples were offered
  void close(const std::string& reason);

  Hub& hub_;
  HubLimits limits_;
  Link link_;
  Outbox outbox_;
  ClientReport report_;
  std::map<std::uint32_t, std::uint32_t> by_channel_;       // channel → subscription
  std::map<std::uint32_t, std::uint32_t> by_subscription_;  // and back
  RateMeter sent_;
  double took_s_ = 0.0;     // when it last took something, or nothing waited
  double allowance_ = 0.0;  // messages that it may still send
  double spoke_s_ = 0.0;
  bool wants_graph_ = false;
  bool closed_ = false;
};

}  // namespace foretrack::station
