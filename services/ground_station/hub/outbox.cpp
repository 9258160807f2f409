// SPDX-License-Identifier: Apache-2.0
#include "services/ground_station/hub/outbox.hpp"

#include <algorithm>

namespace foretrack::station {

void Outbox::drop_front(Lane& lane) {
  bytes_ -= lane.queue.front().frame.bytes();
  lane.queue.pop_front();
  ++dropped_;
}

// What needs it goes with it.
void Outbox::drop_oldest(Lane& lane) {
  const bool is_video = lane.queue.front().chain != Chain::kAlone;
  drop_front(lane);
  while (!lane.queue.empty() && lane.queue.front().chain == Chain::kNeedsPrevious) drop_front(lane);
  lane.broken = is_video && lane.queue.empty();
}

void Outbox::drop_superseded(Lane& lane, double now_s) {
  const auto is_stale = [&](const Waiting& oldest) {
    const bool is_video = oldest.chain != Chain::kAlone;
    return now_s - oldest.since_s > (is_video ? limits_.video_stale_s : limits_.stale_s);
  };
  while (lane.queue.size() > 1 && is_stale(lane.queue.front())) {
    drop_oldest(lane);
    lighten(lane, now_s);
  }
}

// A link that carried the full samples for as long as it had the light ones is good again.
void Outbox::lighten(Lane& lane, double now_s) const {
  if (now_s < lane.light_until_s) return;
  const bool again = now_s - lane.light_until_s < lane.light_for_s;
  lane.light_for_s =
      again ? std::min(2.0 * lane.light_for_s, limits_.light_most_s) : limits_.light_s;
  lane.light_until_s = now_s + lane.light_for_s;
}

bool Outbox::wants_light(std::uint32_t subscription, double now_s) const {
  const auto it = lanes_.find(subscription);
  return it != lanes_.end() && now_s < it->second.light_until_s;
}

void Outbox::make_room(std::size_t bytes) {
  while (bytes_ + bytes > limits_.budget_bytes) {
    Lane* oldest = nullptr;
    for (auto& [id, lane] : lanes_)
      if (!lane.queue.empty() &&
          (!oldest || lane.queue.front().since_s < oldest->queue.front().since_s))
        oldest = &lane;
    if (!oldest) return;
    drop_oldest(*oldest);
  }
}

bool Outbox::push_text(std::shared_ptr<const std::string> text) {
  make_room(text->size());
  bytes_ += text->size();
  texts_.push_back(std::move(text));
  return bytes_ <= limits_.budget_bytes;
}

void Outbox::push_sample(std::uint32_t subscription, const Sample& sample, double now_s) {
  Lane& lane = lanes_[subscription];
  drop_superseded(lane, now_s);
  Frame frame{nullptr, foxglove::message_header(subscription, sample.log_time_ns), sample.data};
  make_room(frame.bytes());
  if (sample.chain != Chain::kNeedsPrevious) lane.broken = false;
  if (lane.broken || bytes_ + frame.bytes() > limits_.budget_bytes) {
    ++dropped_;
    lane.broken = sample.chain != Chain::kAlone;
    return;
  }
  // Who was silent has not saved up: it is served as if it had kept pace.
  if (lane.queue.empty()) lane.spent_bytes = std::max(lane.spent_bytes, served_bytes_);
  bytes_ += frame.bytes();
  lane.queue.push_back({std::move(frame), now_s, sample.chain});
}

void Outbox::rest_after_long_write(double now_s) {
  if (!heaviest_ || now_s <= taken_s_) return;
  const double took_s = now_s - taken_s_;
  if (took_s > limits_.long_s) heaviest_->rests_until_s = now_s + limits_.rest * took_s;
  heaviest_ = nullptr;
  heaviest_bytes_ = 0;
}

Outbox::Lane* Outbox::next_lane(double now_s) {
  Lane* next = nullptr;
  for (auto& [id, lane] : lanes_)
    if (!lane.queue.empty() && now_s >= lane.rests_until_s &&
        (!next || lane.spent_bytes < next->spent_bytes))
      next = &lane;
  return next;
}

std::optional<Frame> Outbox::pop(double now_s) {
  rest_after_long_write(now_s);
  if (!texts_.empty()) {
    Frame frame{std::move(texts_.front()), {}, {}};
    texts_.pop_front();
    bytes_ -= frame.bytes();
    return frame;
  }
  Lane* lane = next_lane(now_s);
  if (!lane) return std::nullopt;
  drop_superseded(*lane, now_s);
  Frame frame = std::move(lane->queue.front().frame);
  lane->queue.pop_front();
  bytes_ -= frame.bytes();
  served_bytes_ = lane->spent_bytes;
  lane->spent_bytes += frame.bytes();
  taken_s_ = now_s;
  if (frame.bytes() > heaviest_bytes_) {
    heaviest_ = lane;
    heaviest_bytes_ = frame.bytes();
  }
  return frame;
}

void Outbox::forget(std::uint32_t subscription) {
  const auto it = lanes_.find(subscription);
  if (it == lanes_.end()) return;
  for (const auto& waiting : it->second.queue) bytes_ -= waiting.frame.bytes();
  if (heaviest_ == &it->second) heaviest_ = nullptr;
  lanes_.erase(it);
}

}  // namespace foretrack::station
