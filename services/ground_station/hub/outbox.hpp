// SPDX-License-Identifier: Apache-2.0
// What waits to be sent to one client: bounded in bytes, newest wins, and no topic holds up
// another.
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
  double stale_s = 0.15;       // a sample that waited so long gives way to a newer one of its topic
  double video_stale_s = 0.6;  // of a video, which then is shown no more until its next key
  double long_s = 0.25;        // a sample that took so long to send makes its topic rest
  double rest = 2.0;           // for so many times as long
  double light_s = 5.0;        // where a sample gave way its topic is light for so long,
  double light_most_s = 60.0;  // and for twice as long each time it happens again, up to this
};

/// A fast client gets everything. For a slow one, old samples give way to newer ones of the same
/// topic, so that what it sees stays live; the budget drops the oldest. Of a video that lost a
/// picture nothing goes out until its next key. Topics share a slow link by
/// bytes (fair queueing). A topic whose sample took long to send, such as a map, then rests for
/// longer than that: small and frequent topics go on meanwhile. Texts go first and are never
/// dropped: when they alone exceed the budget, the client is too slow to be served.
class Outbox {
 public:
  explicit Outbox(const OutboxLimits& limits) : limits_(limits) {}

  /// False: even without samples the budget is exceeded.
  bool push_text(std::shared_ptr<const std::string> text);
  void push_sample(std::uint32_t subscription, const Sample& sample, double now_s);
  /// The next to send; none: nothing may be sent now. What is taken at one time is sent together,
  /// and is sent when one asks again.
  std::optional<Frame> pop(double now_s);
  /// Whether of late the link did not carry all samples of the subscription: where they can be
  /// lighter, they should.
  bool wants_light(std::uint32_t subscription, double now_s) const;
  /// Forgets the samples of a subscription that ended.
  void forget(std::uint32_t subscription);

  std::size_t bytes() const { return bytes_; }
  std::uint64_t dropped() const { return dropped_; }

 private:
  struct Waiting {
    Frame frame;
    double since_s = 0.0;
    Chain chain = Chain::kAlone;
  };
  struct Lane {  // of a subscription
    std::deque<Waiting> queue;
    std::uint64_t spent_bytes = 0;  // of the link, since it began to wait
    double rests_until_s = 0.0;
    bool broken = false;  // a video without its next key
    double light_until_s = 0.0, light_for_s = 0.0;
  };
  void drop_front(Lane& lane);
  void make_room(std::size_t bytes);
  void drop_oldest(Lane& lane);
  void drop_superseded(Lane& lane, double now_s);
  void lighten(Lane& lane, double now_s) const;
  void rest_after_long_write(double now_s);
  Lane* next_lane(double now_s);

  OutboxLimits limits_;
  std::deque<std::shared_ptr<const std::string>> texts_;
  std::map<std::uint32_t, Lane> lanes_;
  std::uint64_t served_bytes_ = 0;  // what the lane had spent that was served last
  Lane* heaviest_ = nullptr;        // of what was taken last; null: nothing
  std::size_t heaviest_bytes_ = 0;
  double taken_s_ = 0.0;
  std::size_t bytes_ = 0;
  std::uint64_t dropped_ = 0;
};

}  // namespace foretrack::station
