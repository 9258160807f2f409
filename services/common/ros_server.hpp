// SPDX-License-Identifier: Apache-2.0
// A service of ROS 2 over DDS: a topic of requests and one of replies.
//
// Whose reply it is, rmw_fastrtps tells beside the sample (related_sample_identity), rmw_cyclonedds
// in the first 16 bytes of it. Both are answered in their own way.
#pragma once

#include <deque>
#include <functional>
#include <string>

#include "services/common/node.hpp"
#include "services/common/raw.hpp"

namespace foretrack {

struct RosServiceInfo {
  std::string name;  // "uav1/planning/list_parameters"
  std::string type;  // "rcl_interfaces::srv::dds_::ListParameters": what _Request_ follows
};

/// For the node's thread. A reply waits for the client's reader to be there, for ten seconds.
class RosServer {
 public:
  /// Of a request, without what says whose it is. Empty: it cannot be read, and gets no reply.
  using Answer = std::function<CdrBytes(const CdrBytes&)>;
  RosServer(Node& node, const RosServiceInfo& info, Answer answer);

  /// Answers what came.
  void update();
  /// A reply waits: call update() soon.
  bool waits() const { return !waiting_.empty(); }
  RawReader& requests() { return requests_; }

 private:
  struct Reply {
    CdrBytes bytes;
    RequestId to;
    double until_s;
  };
  void answer(const CdrBytes& request, const RequestId& from);

  Answer answer_;
  RawReader requests_;
  RawWriter replies_;
  std::deque<Reply> waiting_;  // bounded
};

}  // namespace foretrack
