// SPDX-License-Identifier: Apache-2.0
// The station's own view of everything, as JSON: the channel /station/status and GET /api/status.
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "services/ground_station/bus/source.hpp"
#include "services/ground_station/hub/hub.hpp"

namespace foretrack::station {

struct ServerStatus {
  std::string version;
  double uptime_s = 0.0;
  bool control_enabled = false;
  bool needs_token = false;
};

struct RecordingStatus {
  std::string file;         // that is written now
  std::uint64_t bytes = 0;  // of all files
  double seconds = 0.0;
  std::uint64_t lost = 0;  // samples that the disk could not take
};

/// An order that the gate does not answer.
struct Unconfirmed {
  std::string command, operator_name;
  bool still_sent = false;  // else it was given up
};

/// What the gate of a vehicle says of orders.
struct MissionStatus {
  std::string lease_operator;  // empty: nobody holds it
  double lease_expires_s = 0.0;
  std::uint64_t command_id = 0;  // 0: there was none
  std::string command, operator_name, result, reason;
  std::optional<Unconfirmed> unconfirmed;
  std::string refused;  // why the station cannot write orders to it; empty: it can, or need not
};

struct Status {
  ServerStatus server;
  std::vector<VehicleReport> vehicles;
  std::map<std::string, MissionStatus> missions;  // by vehicle
  std::optional<RecordingStatus> recording;
  std::string recording_fault;        // why the last one ended by itself; empty: it did not
  std::vector<std::string> warnings;  // of the bus
  std::vector<TopicReport> topics;
  std::set<std::uint32_t> limited;  // channels
  std::vector<ClientReport> clients;
};

std::string to_json_text(const Status& status);

/// The channel that carries it; its id is 0, below those of the bus.
Channel status_channel();

}  // namespace foretrack::station
