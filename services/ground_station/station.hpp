// The ground station: a DDS participant on one side, a web server on the other.
#pragma once

#include <filesystem>
#include <set>
#include <string>

#include "services/common/node.hpp"
#include "services/common/stop.hpp"
#include "services/ground_station/http/server.hpp"
#include "services/ground_station/hub/hub.hpp"

namespace foretrack::station {

struct StationOptions {
  NodeOptions node;
  ServerOptions server;
  HubLimits limits;
  std::filesystem::path page;  // folder with index.html; need not exist
  std::set<std::string> more_hosts, more_origins;
};

/// Until the stop is requested. Prints the page's address. Throws std::runtime_error if the port
/// cannot be used.
void run_station(const StationOptions& options, Stop& stop);

}  // namespace foretrack::station
