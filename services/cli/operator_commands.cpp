// SPDX-License-Identifier: Apache-2.0
#include "services/cli/commands.hpp"

namespace foretrack {

std::vector<Command> operator_commands() {
  return {
      {"demo", "a flight in simulation: start, watch, measure, write down", prepare_demo},
      {"up", "the simulator and every service, each as its own process", prepare_up},
      {"order", "an order to a vehicle: start, hold, land, stop", prepare_order},
      {"monitor", "one vehicle, live, in the terminal", prepare_monitor},
      {"topics", "every topic: rate, age, writers, readers, mismatches", prepare_topics},
      {"doctor", "why the vehicle does not move", prepare_doctor},
      {"station", "the ground station: watch, record and command from a browser", prepare_station},
      {"record", "every topic to MCAP files", prepare_record},
      {"replay", "a recording, to the station's page or onto the bus", prepare_replay},
      {"report", "what happened in a recording, as one page", prepare_report},
      {"clip", "what a vehicle saw in a recording, as a video", prepare_clip},
      {"discovery-server", "where processes meet that multicast does not reach",
       prepare_discovery_server},
      {"security", "keys for a secured bus: make, renew, check, revoke", prepare_security}};
}

}  // namespace foretrack
