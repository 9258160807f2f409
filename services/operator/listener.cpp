// SPDX-License-Identifier: Apache-2.0
#include "services/operator/listener.hpp"

#include <fmt/format.h>

#include <set>

#include "services/operator/topic_watch.hpp"

namespace foretrack {
namespace {

constexpr double kNoWallClock_s = 1e8;  // stamps before 1973 are simulated time

// Every vehicle of ours has rt/<vehicle>/target/state.
std::vector<std::string> other_vehicles(const std::vector<ForeignEndpoint>& endpoints,
                                        const std::string& own) {
  constexpr std::string_view kHead = "rt/";
  constexpr std::string_view kTail = "/target/state";
  std::set<std::string> names;
  for (const auto& e : endpoints) {
    if (!e.topic.starts_with(kHead) || !e.topic.ends_with(kTail)) continue;
    const auto name = e.topic.substr(kHead.size(), e.topic.size() - kHead.size() - kTail.size());
    if (name != own) names.insert(name);
  }
  return {names.begin(), names.end()};
}

std::string sentence_of(const ForeignEndpoint& e) {
  return fmt::format("a {} on {} will never match: {}.", e.writes ? "writer" : "reader", e.topic,
                     e.why);
}

}  // namespace

template <class Topic>
template <class Hook>
void Listener::Kept<Topic>::take(const Hook& hook) {
  reader.take_each([&](auto& taken) {
    if (hook) hook(taken);
    std::swap(sample, taken);
    any = true;
  });
}

template <class Topic>
void Listener::watch(const Reader<Topic>& reader) {
  slots_.push_back({Topic::info.name, &reader.stats(), {}});
}

Listener::Listener(Node& node, bool with_images)
    : node_(node),
      odometry_(node),
      observation_(node),
      color_info_(node),
      target_(node),
      intention_(node),
      prediction_(node),
      plan_(node),
      safety_(node),
      health_(node),
      simulated_clock_(node),
      vehicle_truth_(node),
      target_truth_(node) {
  watch(odometry_.reader);
  watch(observation_);
  if (with_images) watch(depth_.emplace(node));
  watch(target_.reader);
  if (with_images) watch(map_.emplace(node));
  watch(intention_.reader);
  watch(prediction_.reader);
  watch(plan_.reader);
  watch(safety_.reader);
}

void Listener::hear(const foretrack_msgs::msg::ServiceHealth& health) {
  auto& heard = services_[health.service().c_str()];
  heard.report.health = health;
  heard.at_s = node_.clock().steady_s();
  const double stamp_s = to_seconds(health.header().stamp());
  const double now_s = stamp_s < kNoWallClock_s ? simulated_s_ : node_.clock().now_s();
  heard.report.clock_ahead_s = now_s < 0.0 ? 0.0 : stamp_s - now_s;
}

void Listener::take_images() {
  if (depth_) depth_->take_newest();
  if (!map_) return;
  if (const auto* map = map_->take_newest())
    map_is_static_ = to_seconds(map->header().stamp()) == 0.0;
}

void Listener::update() {
  if (const auto* clock = simulated_clock_.take_newest()) simulated_s_ = to_seconds(clock->clock());
  vehicle_truth_.take(hooks.vehicle_truth);
  target_truth_.take(hooks.target_truth);
  odometry_.take(std::function<void(const nav_msgs::msg::Odometry&)>());
  observation_.take_newest();
  color_info_.take_each([this](const auto& info) {
    if (hooks.color_image) hooks.color_image(to_seconds(info.header().stamp()));
  });
  take_images();
  target_.take(hooks.target);
  intention_.take(hooks.intention);
  prediction_.take(hooks.prediction);
  plan_.take(hooks.plan);
  safety_.take(hooks.safety);
  health_.take_each([this](const auto& health) { hear(health); });
  const double now_s = node_.clock().steady_s();
  if (simulated_s_ >= 0.0)
    time_rate_ = 1e-3 * simulated_ms_.update(static_cast<std::uint64_t>(1e3 * simulated_s_), now_s);
  for (auto& slot : slots_) slot.rate_hz = slot.meter.update(slot.stats->samples, now_s);
}

FlightSnapshot Listener::snapshot() {
  FlightSnapshot p;
  p.vehicle = node_.options().names.vehicle;
  p.domain = node_.options().domain_id;
  p.this_machine_only = node_.this_machine_only();
  p.unsecured = node_.why_unsecured();
  p.now_s = simulated_s_ >= 0.0 ? simulated_s_ : node_.clock().now_s();
  p.time_rate = time_rate_;
  p.map_is_static = map_is_static_;
  p.odometry = odometry_.newest();
  p.vehicle_truth = vehicle_truth_.newest();
  p.target_truth = target_truth_.newest();
  p.target = target_.newest();
  p.intention = intention_.newest();
  p.prediction = prediction_.newest();
  p.plan = plan_.newest();
  p.safety = safety_.newest();
  const double now_s = node_.clock().steady_s();
  for (auto& [name, heard] : services_) {
    heard.report.age_s = now_s - heard.at_s;
    p.services.push_back(heard.report);
  }
  for (const auto& slot : slots_) p.flows.push_back(flow_of(slot.topic, *slot.stats, slot.rate_hz));
  p.other_vehicles = other_vehicles(node_.endpoints(), p.vehicle);
  for (const auto& endpoint : node_.foreign_endpoints()) p.foreign.push_back(sentence_of(endpoint));
  return p;
}

}  // namespace foretrack
