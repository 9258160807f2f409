// What waits to be sent to one client: bounded in bytes, and newest wins.
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "services/ground_station/bus/channel.hpp"
#include "services/ground_station/foxglove/protocol.hpp"

namespace foretrack::station {

/// One WebSocket message.
struct Frame {
  std::shared_ptr<const std::string> text;  // or, if null, a sample with its header
  std::array<std::uint8_t, foxglove::kMessageHeaderBytes> header{};
  std::shared_ptr<const Bytes> data;

  std::size_t bytes() const { return text ? text->size() : header.size() + data->size(); }
};

struct OutboxLimits {
  std::size_t budget_bytes = 8u << 20;
  double stale_s = 0.15;  // a sample that waited so long gives way to a newer one of its topic
};

/// A fast client gets everything. For a slow one, old samples give way to newer ones of the same
/// topic, so that what it sees stays live; the budget drops the oldest. Texts are never dropped:
/// when they alone exceed the budget, the client is too slow to be served.
class Outbox {
 public:
  explicit Outbox(const OutboxLimits& limits) : limits_(limits) {}

  /// False: even without samples the budget is exceeded.
  bool push_text(std::shared_ptr<const std::string> text);
  void push_sample(std::uint32_t subscription, const Sample& sample, double now_s);
  /// The next to send; none: nothing waits.
  std::optional<Frame> pop(double now_s);
  /// Forgets the samples of a subscription that ended.
  void forget(std::uint32_t subscription);

  std::size_t bytes() const { return bytes_; }
  std::uint64_t dropped() const { return dropped_; }

 private:
  struct Waiting {
    Frame frame;
    std::uint32_t subscription = 0;
    double since_s = 0.0;
  };
  void make_room(std::size_t bytes);
  void leave(const Waiting& waiting);

  OutboxLimits limits_;
  std::deque<Waiting> queue_;
  std::map<std::uint32_t, int> waiting_;  // samples, by subscription
  std::size_t bytes_ = 0;
  std::uint64_t dropped_ = 0;
};

}  // namespace foretrack::station
