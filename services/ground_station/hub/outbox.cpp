#include "services/ground_station/hub/outbox.hpp"

#include <algorithm>

namespace foretrack::station {

void Outbox::leave(const Waiting& waiting) {
  bytes_ -= waiting.frame.bytes();
  if (!waiting.frame.text) --waiting_[waiting.subscription];
}

void Outbox::make_room(std::size_t bytes) {
  for (auto it = queue_.begin(); it != queue_.end() && bytes_ + bytes > limits_.budget_bytes;) {
    if (it->frame.text) {
      ++it;
      continue;
    }
    leave(*it);
    ++dropped_;
    it = queue_.erase(it);
  }
}

bool Outbox::push_text(std::shared_ptr<const std::string> text) {
  make_room(text->size());
  bytes_ += text->size();
  queue_.push_back({{std::move(text), {}, {}}, 0, 0.0});
  return bytes_ <= limits_.budget_bytes;
}

void Outbox::push_sample(std::uint32_t subscription, const Sample& sample, double now_s) {
  Frame frame{nullptr, foxglove::message_header(subscription, sample.log_time_ns), sample.data};
  make_room(frame.bytes());
  if (bytes_ + frame.bytes() > limits_.budget_bytes) {
    ++dropped_;
    return;
  }
  bytes_ += frame.bytes();
  ++waiting_[subscription];
  queue_.push_back({std::move(frame), subscription, now_s});
}

std::optional<Frame> Outbox::pop(double now_s) {
  while (!queue_.empty()) {
    Waiting next = std::move(queue_.front());
    queue_.pop_front();
    const bool superseded = !next.frame.text && now_s - next.since_s > limits_.stale_s &&
                            waiting_[next.subscription] > 1;
    leave(next);
    if (!superseded) return std::move(next.frame);
    ++dropped_;
  }
  return std::nullopt;
}

void Outbox::forget(std::uint32_t subscription) {
  const auto is_its = [&](const Waiting& w) {
    return !w.frame.text && w.subscription == subscription;
  };
  for (const auto& waiting : queue_)
    if (is_its(waiting)) bytes_ -= waiting.frame.bytes();
  std::erase_if(queue_, is_its);
  waiting_.erase(subscription);
}

}  // namespace foretrack::station
