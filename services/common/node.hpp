// SPDX-License-Identifier: Apache-2.0
// A service on the bus: one DDS participant, its topics, and what went wrong with its peers.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "services/common/clock.hpp"
#include "services/common/dds_log.hpp"
#include "services/common/endpoint.hpp"
#include "services/common/names.hpp"
#include "services/common/peer.hpp"
#include "services/common/wire_filter.hpp"

namespace foretrack {

/// A remote endpoint on one of our topics that can never match, which DDS itself does not report.
struct ForeignEndpoint {
  std::string topic;
  std::string type;
  bool keyed = false;
  bool writes = false;
  std::string why;
  bool reliable = false;      // offers or asks for it
  bool latched = false;       // transient local or more
  PeerId peer{};              // whose it is
  std::string other_version;  // what is wrong if its type is another one under our name
};

struct NodeOptions {
  std::string service;
  Names names;
  int domain_id = 0;
  bool use_sim_time = false;
  /// Of ROS 2, in whose node list we appear: "humble"; empty: Iron and all later ones.
  std::string ros_distro;
  /// The network interface's name, an address of it, or "any"; empty: the loopback one, unless the
  /// profile names others (its transports' interfaceWhiteList).
  std::string interface;
  /// Folder of an identity of DDS-Security, as SROS2 lays it out, or of several, from which that of
  /// the service's role is taken; empty: what the profile says.
  std::string security;
  /// "HOST" or "HOST:PORT", where others are looked for besides by multicast.
  std::vector<std::string> peers;
  /// Of Fast DDS, "HOST:PORT", or several with a ; between them: all are met there, none by
  /// multicast.
  std::string discovery_server;
  /// To be such a server itself, on this UDP port; 0: not.
  int serve_discovery_port = 0;
};

/// Not thread-safe but for report(): one service, one thread. Writers and readers are its own, and
/// go with it. Clean-up is bounded: after 2 s the process is left at once.
class Node {
 public:
  /// Throws std::runtime_error if DDS refuses, std::invalid_argument on bad names.
  explicit Node(const NodeOptions& options);
  ~Node();
  Node(const Node&) = delete;
  Node& operator=(const Node&) = delete;

  const NodeOptions& options() const { return options_; }
  Clock& clock() { return *clock_; }

  /// Tells ROS 2's tools which endpoints this node has. Cheap; again after new endpoints.
  void announce();

  WriterCore& add_writer(const TopicInfo& info, const TypeOps& ops);
  ReaderCore& add_reader(const TopicInfo& info, const TypeOps& ops);
  const std::vector<std::unique_ptr<WriterCore>>& writers() const { return writers_; }
  const std::vector<std::unique_ptr<ReaderCore>>& readers() const { return readers_; }

  /// Logs the text and keeps it as the last error. From any thread.
  void report(const std::string& text);
  std::string last_error() const;
  std::vector<ForeignEndpoint> foreign_endpoints() const;
  /// All that discovery tells of, on any topic; `why` is empty where it may match.
  std::vector<ForeignEndpoint> endpoints() const;
  /// Grows whenever endpoints() changes.
  std::uint64_t discoveries() const;
  /// Messages that were not read as they should be, and how many were.
  const WireFilter& wire() const { return *wire_; }
  /// Counts and reports whom DDS-Security refused, as `wire()` does messages. From any thread.
  void refuse_peer(wire::Fault fault, const std::string& who) { wire_->refuse(fault, who); }
  /// Which interfaces DDS uses. This machine's own: nobody else is heard.
  bool this_machine_only() const { return this_machine_only_; }
  /// By DDS-Security, as the profile has it.
  bool secured() const { return secured_; }
  /// A sentence for people if others than this machine's can take part, and nothing tells who is
  /// who; else empty.
  const char* why_unsecured() const;
  /// The other participants that discovery holds for alive.
  std::vector<Peer> peers() const;
  /// After so long without a word of ours, others drop us.
  double lease_s() const;

  struct Dds;
  Dds& dds() { return *dds_; }

 private:
  NodeOptions options_;
  std::unique_ptr<Dds> dds_;
  std::shared_ptr<WireFilter> wire_;
  std::unique_ptr<RoleWatch> role_watch_;  // where the bus is secured
  bool this_machine_only_ = false, secured_ = false;
  std::vector<std::unique_ptr<WriterCore>> writers_;
  std::vector<std::unique_ptr<ReaderCore>> readers_;
  std::unique_ptr<Clock> clock_;
};

/// Runs the clean-up; if it takes longer than the limit, logs and leaves the process with
/// kCleanupFailed, without destructors.
inline constexpr int kCleanupFailed = 70;
void run_bounded(double limit_s, const std::function<void()>& cleanup);

}  // namespace foretrack
