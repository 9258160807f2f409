// SPDX-License-Identifier: Apache-2.0
// What discovery knows, by topic: who writes and reads it, with which type, and who cannot match.
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "services/common/node.hpp"

namespace foretrack::station {

struct SurveyedTopic {
  std::string type;  // of the contract, else of its first writer
  bool keyed = false;
  int writers = 0;  // of that type
  int readers = 0;  // of any type
  std::set<PeerId> writing, reading;
  std::string foreign_type;        // that somebody else uses on this topic; empty: none
  bool qos_mismatch = false;       // some reader asks for more than some writer offers
  const char* profile = "sensor";  // with which a reader here hears all its writers
};

/// By name on the wire; only those of ROS 2's name space (rt/), as the rest is the middleware's.
std::map<std::string, SurveyedTopic> survey(const std::vector<ForeignEndpoint>& endpoints);

}  // namespace foretrack::station
