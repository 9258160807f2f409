// SPDX-License-Identifier: Apache-2.0
#include "services/common/ros_server.hpp"

#include "services/common/time_now.hpp"

namespace foretrack {
namespace {

constexpr double kPatience_s = 10.0;  // discovery of a client may take seconds on a busy machine
constexpr std::size_t kMostWaiting = 32;
constexpr std::size_t kHeaderBytes = 4;     // of CDR
constexpr std::size_t kIdentityBytes = 16;  // of rmw_cyclonedds: who asks, and its number

RawTopic topic_of(const RosServiceInfo& info, bool request) {
  return {(request ? "rq/" : "rr/") + info.name + (request ? "Request" : "Reply"),
          info.type + (request ? "_Request_" : "_Response_")};
}

// RTPS' number of the vendor, which begins the id of each participant.
bool is_cyclone(const RequestId& from) {
  return from.writer[0] == 0x01 && from.writer[1] == 0x10;
}

}  // namespace

RosServer::RosServer(Node& node, const RosServiceInfo& info, Answer answer)
    : answer_(std::move(answer)),
      requests_(node, topic_of(info, true), "command"),
      replies_(node, topic_of(info, false), "command") {
  requests_.show_to_ros();
  replies_.show_to_ros();
}

void RosServer::answer(const CdrBytes& request, const RequestId& from) {
  CdrBytes plain = request, identity;
  if (is_cyclone(from)) {
    if (request.size() < kHeaderBytes + kIdentityBytes) return;
    const auto begin = plain.begin() + kHeaderBytes;
    identity.assign(begin, begin + kIdentityBytes);
    plain.erase(begin, begin + kIdentityBytes);  // 16 bytes: alignment stays
  }
  CdrBytes reply = answer_(plain);
  if (reply.empty() || waiting_.size() == kMostWaiting) return;
  reply.insert(reply.begin() + kHeaderBytes, identity.begin(), identity.end());
  waiting_.push_back({std::move(reply), from, steady_s() + kPatience_s});
}

void RosServer::update() {
  CdrBytes request;
  RequestId from;
  while (requests_.take_request(request, from)) answer(request, from);
  for (std::size_t left = waiting_.size(); left > 0; --left) {
    Reply reply = std::move(waiting_.front());
    waiting_.pop_front();
    if (replies_.reaches(reply.to))
      replies_.reply(reply.bytes, reply.to);
    else if (steady_s() < reply.until_s)
      waiting_.push_back(std::move(reply));
  }
}

}  // namespace foretrack
