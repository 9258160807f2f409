// SPDX-License-Identifier: Apache-2.0
#include "services/ground_station/hub/client.hpp"

#include <algorithm>

#include "services/ground_station/hub/hub.hpp"
#include "services/ground_station/hub/video_chain.hpp"

namespace foretrack::station {

Client::Client(Hub& hub, std::uint64_t id, std::string address, Link link, const HubLimits& limits)
    : hub_(hub),
      limits_(limits),
      link_(std::move(link)),
      outbox_({limits.client_budget_bytes}),
      allowance_(limits.messages_s) {
  report_.id = id;
  report_.address = std::move(address);
}

void Client::close(const std::string& reason) {
  if (closed_) return;
  closed_ = true;
  link_.close(reason);
}

void Client::tell(std::shared_ptr<const std::string> text) {
  if (closed_) return;
  if (!outbox_.push_text(std::move(text))) return close("too slow: its budget is used up");
  link_.wake();
}

void Client::offer(PerLink& sample, double now_s) {
  const auto it = by_channel_.find(sample.full().channel);
  if (it == by_channel_.end() || closed_) return;
  const bool light = sample.can_be_lighter() && outbox_.wants_light(it->second, now_s);
  outbox_.push_sample(it->second, light ? sample.light() : sample.full(), now_s);
}

void Client::flush() {
  if (!closed_ && outbox_.bytes() > 0) link_.wake();
}

std::optional<Frame> Client::next(double now_s) {
  took_s_ = now_s;
  auto frame = outbox_.pop(now_s);
  if (frame) report_.sent_bytes += frame->bytes();
  return frame;
}

bool Client::may_speak(double now_s) {
  allowance_ = std::min(limits_.messages_s, allowance_ + limits_.messages_s * (now_s - spoke_s_));
  spoke_s_ = now_s;
  if (allowance_ < 1.0) {
    close("too many messages");
    return false;
  }
  allowance_ -= 1.0;
  return true;
}

void Client::on_text(std::string_view text, double now_s) {
  if (may_speak(now_s)) handle(foxglove::parse_text(text), now_s);
}

void Client::on_binary(std::span<const std::uint8_t> data, double now_s) {
  if (may_speak(now_s)) handle(foxglove::parse_binary(data), now_s);
}

void Client::subscribe(const foxglove::Subscribe& wanted, double now_s) {
  using foxglove::Level;
  for (const auto& [id, channel] : wanted.subscriptions) {
    const auto it = hub_.channels_.find(channel);
    if (it == hub_.channels_.end()) {
      tell(status(Level::kWarning, "there is no channel " + std::to_string(channel)));
    } else if (by_subscription_.contains(id) || by_channel_.contains(channel)) {
      tell(status(Level::kError, "already subscribed: channel " + std::to_string(channel)));
    } else if (by_channel_.size() >= limits_.subscriptions) {
      tell(status(Level::kError, "too many subscriptions"));
    } else {
      by_channel_[channel] = id;
      by_subscription_[id] = channel;
      for (const auto& sample : hub_.kept(it->second, now_s)) {
        PerLink kept(it->second, sample);
        offer(kept, now_s);
      }
    }
  }
  flush();
}

void Client::handle(const foxglove::ClientMessage& message, double now_s) {
  using foxglove::Level;
  if (const auto* wanted = std::get_if<foxglove::Subscribe>(&message)) {
    subscribe(*wanted, now_s);
  } else if (const auto* ended = std::get_if<foxglove::Unsubscribe>(&message)) {
    for (const auto id : ended->ids) {
      const auto it = by_subscription_.find(id);
      if (it == by_subscription_.end()) continue;
      outbox_.forget(id);
      by_channel_.erase(it->second);
      by_subscription_.erase(it);
    }
  } else if (const auto* graph = std::get_if<foxglove::WantGraph>(&message)) {
    const bool is_new = graph->wanted && !wants_graph_;
    wants_graph_ = graph->wanted;
    if (auto all = foxglove::graph_update({}, hub_.graph_); is_new && !all.empty())
      tell(std::move(all));
    return;
  } else if (const auto* other = std::get_if<foxglove::NotOffered>(&message)) {
    return tell(status(Level::kWarning, "this server does not offer '" + other->op + "'"));
  } else {
    return tell(status(Level::kError, std::get<foxglove::Malformed>(message).why));
  }
  report_.subscriptions = by_channel_.size();
  report_.watches = std::any_of(by_channel_.begin(), by_channel_.end(), [this](const auto& entry) {
    const auto it = hub_.channels_.find(entry.first);
    return it != hub_.channels_.end() && !is_ground_picture(it->second);
  });
  if (hub_.on_interest) hub_.on_interest();
}

}  // namespace foretrack::station
