// SPDX-License-Identifier: Apache-2.0
// The ground station: samples from the bus or a recording on one side, a web server on the other.
#pragma once

#include <filesystem>
#include <optional>
#include <set>
#include <string>

#include "services/common/node.hpp"
#include "services/common/stop.hpp"
#include "services/ground_station/http/server.hpp"
#include "services/ground_station/hub/hub.hpp"
#include "services/ground_station/recording/recorder.hpp"
#include "services/ground_station/recording/replay.hpp"

namespace foretrack::station {

struct StationOptions {
  NodeOptions node;
  ServerOptions server;
  HubLimits limits;
  RecorderOptions recorder;
  std::optional<ReplayOptions> replay;  // instead of the bus
  std::filesystem::path page;           // folder with index.html; need not exist
  std::filesystem::path map;            // what lies under the page's map; empty: nothing
  std::set<std::string> more_hosts, more_origins;
  std::filesystem::path token_file, audit_file;
  bool enable_control = false;
  bool insecure_lan = false;  // serve other machines without TLS
  bool print_token = false;   // in the page's address
  bool record = false;        // from the beginning
};

/// $XDG_CONFIG_HOME/foretrack/station.tokens and $XDG_STATE_HOME/foretrack/station-audit.jsonl.
std::filesystem::path default_token_file();
std::filesystem::path default_audit_file();

/// Until the stop is requested. Prints the page's address. Throws std::invalid_argument if the
/// address is not loopback and neither TLS nor insecure_lan is chosen, std::runtime_error if the
/// port or a file cannot be used.
void run_station(const StationOptions& options, Stop& stop);

}  // namespace foretrack::station
