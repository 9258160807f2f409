// SPDX-License-Identifier: Apache-2.0
// Every topic of topics.hpp at once: what comes, how fast, from how many.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "services/common/node.hpp"
#include "services/common/rate.hpp"
#include "services/operator/flight_snapshot.hpp"

namespace foretrack {

class TopicWatch {
 public:
  explicit TopicWatch(Node& node);

  /// Takes and drops all that came. Call it twenty times a second.
  void update();
  std::vector<TopicFlow> flows() const;

 private:
  struct Slot {
    std::string topic;
    const EndpointStats* stats;
    std::function<void()> take;
    RateMeter meter;
    double rate_hz = 0.0;
  };
  template <class Topic>
  void watch();

  Node& node_;
  std::vector<Slot> slots_;
};

/// How the samples of one endpoint flow.
TopicFlow flow_of(std::string_view topic, const EndpointStats& stats, double rate_hz);

}  // namespace foretrack
