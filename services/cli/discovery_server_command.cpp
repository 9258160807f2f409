// SPDX-License-Identifier: Apache-2.0
// foretrack discovery-server: tells processes of each other where multicast does not pass. The one
// of Fast DDS does the same, but without the filter one datagram of anybody ends it.
#include <fmt/format.h>

#include <chrono>
#include <cstdio>
#include <memory>
#include <thread>

#include "services/cli/commands.hpp"
#include "services/common/node.hpp"
#include "services/common/options.hpp"
#include "services/common/stop.hpp"

namespace foretrack {
namespace {

constexpr int kDefaultPort = 11811;

int run_server(const NodeOptions& options) {
  set_up_logging("info");
  Stop stop;
  SignalStop signals(stop);
  const Node node(options);
  fmt::print("discovery server on UDP port {}{}\n", options.serve_discovery_port,
             node.this_machine_only() ? ", for this machine alone" : "");
  std::fflush(stdout);
  while (!stop.requested()) std::this_thread::sleep_for(std::chrono::milliseconds(100));
  return 0;
}

}  // namespace

std::function<int()> prepare_discovery_server(CLI::App& app) {
  auto options = std::make_shared<NodeOptions>();
  options->service = "discovery_server";
  options->serve_discovery_port = kDefaultPort;
  app.add_option("--port", options->serve_discovery_port, "UDP port")
      ->check(CLI::Range(1, 65535))
      ->capture_default_str();
  app.add_option("--interface", options->interface, "Network interface: a name, an address, or any")
      ->envname("FORETRACK_INTERFACE");
  return [options] { return run_server(*options); };
}

}  // namespace foretrack
