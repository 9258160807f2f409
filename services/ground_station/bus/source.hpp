// SPDX-License-Identifier: Apache-2.0
// Where samples come from: the bus, or a recording.
#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "services/common/stop.hpp"
#include "services/ground_station/bus/channel.hpp"

namespace foretrack::station {

/// One topic as operators see it.
struct TopicReport {
  std::uint32_t channel = 0;  // 0: there is none, as nobody writes it
  std::string topic, type, vehicle;
  int writers = 0, readers = 0;
  double rate_hz = 0.0, bytes_s = 0.0;
  double age_s = -1.0;   // since the last sample; negative: none yet
  bool resting = false;  // large, and nobody wants it: rates are the last known
  bool qos_mismatch = false;
  std::string foreign_type;
  std::vector<std::string> publishers, subscribers;  // names of participants
};

struct VehicleReport {
  std::string name;
  double seen_s_ago = -1.0;             // since any sample; negative: none yet
  std::optional<double> clock_ahead_s;  // of this machine's clock; none: not known, or simulated
};

/// Calls its outlet in run()'s thread; the rest may be called from any.
class Source {
 public:
  virtual ~Source() = default;
  virtual void run(Stop& stop) = 0;
  /// The channels that somebody reads or records.
  virtual void want(std::set<std::uint32_t> channels) = 0;
  virtual std::vector<TopicReport> topics() const = 0;
  virtual std::vector<VehicleReport> vehicles() const = 0;
  /// What an operator should know of the bus itself, a sentence each.
  virtual std::vector<std::string> warnings() const { return {}; }
};

}  // namespace foretrack::station
