// SPDX-License-Identifier: Apache-2.0
// Channels on one side, clients on the other: who is subscribed to what, and gets it.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "services/ground_station/bus/channel.hpp"
#include "services/ground_station/foxglove/protocol.hpp"
#include "services/ground_station/hub/client.hpp"

namespace foretrack::station {

/// Belongs to one thread.
class Hub {
 public:
  Hub(std::string name, std::string version, const HubLimits& limits);

  void open(const Channel& channel);
  void close(std::uint32_t channel);
  void deliver(const std::vector<Sample>& samples, double now_s);
  /// Tells what changed to those clients that want to know.
  void set_graph(foxglove::Graph graph);

  std::shared_ptr<Client> join(std::string address, Link link, double now_s);
  void leave(const Client& client);
  /// Closes who has stalled. Call it a few times a second.
  void check(double now_s);

  const std::map<std::uint32_t, Channel>& channels() const { return channels_; }
  /// The channels that any client is subscribed to.
  std::set<std::uint32_t> wanted() const;
  /// Whether samples of the channel were left out in the last two seconds.
  bool limited(std::uint32_t channel, double now_s) const;
  std::vector<ClientReport> clients(double now_s);

  /// Called when a client subscribes or unsubscribes.
  std::function<void()> on_interest;

 private:
  friend class Client;
  struct Flow {
    double allowance_bytes = 0.0;
    double last_s = -1.0;
    double limited_s = -1e9;   // when a sample was last left out
    std::vector<Sample> kept;  // for who subscribes late: the last one that stands alone
    std::size_t kept_bytes = 0;
    double kept_s = -1e9;
  };
  static void keep(Flow& flow, const Channel& channel, const Sample& sample, double now_s);
  std::span<const Sample> kept(const Channel& channel, double now_s) const;
  bool within_limit(Flow& flow, std::size_t bytes, double now_s) const;

  std::string name_, version_, session_id_;
  HubLimits limits_;
  std::map<std::uint32_t, Channel> channels_;
  std::map<std::uint32_t, Flow> flows_;
  std::map<std::uint64_t, std::shared_ptr<Client>> clients_;
  foxglove::Graph graph_;
  std::uint64_t next_client_ = 1;
};

}  // namespace foretrack::station
