#include "services/ground_station/listener.hpp"

#include <fmt/format.h>

namespace foretrack {
namespace {

template <class Topic, class Hook>
void pass_on(Reader<Topic>& reader, const Hook& hook) {
  reader.take_each([&](const auto& sample) {
    if (hook) hook(sample);
  });
}

std::string sentence_of(const ForeignEndpoint& e) {
  return fmt::format("a {} on {} will never match: {}.", e.writes ? "writer" : "reader", e.topic,
                     e.why);
}

}  // namespace

template <class Topic>
void Listener::watch(const Reader<Topic>& reader) {
  slots_.push_back({Topic::info.name, &reader.stats(), {}});
}

Listener::Listener(Node& node, bool with_images)
    : node_(node),
      odometry_(node),
      observation_(node),
      target_(node),
      intention_(node),
      prediction_(node),
      plan_(node),
      safety_(node),
      health_(node),
      vehicle_truth_(node),
      target_truth_(node) {
  watch(odometry_);
  watch(observation_);
  if (with_images) watch(depth_.emplace(node));
  watch(target_);
  if (with_images) watch(map_.emplace(node));
  watch(intention_);
  watch(prediction_);
  watch(plan_);
  watch(safety_);
}

void Listener::hear(const foretrack_msgs::msg::ServiceHealth& health) {
  auto& heard = services_[health.service().c_str()];
  heard.report.health = health;
  heard.report.clock_ahead_s = to_seconds(health.header().stamp()) - node_.clock().now_s();
  heard.at_s = node_.clock().steady_s();
}

void Listener::update() {
  odometry_.take_newest();
  observation_.take_newest();
  if (depth_) depth_->take_newest();
  if (map_) map_->take_newest();
  pass_on(vehicle_truth_, hooks.vehicle_truth);
  pass_on(target_truth_, hooks.target_truth);
  pass_on(target_, hooks.target);
  pass_on(intention_, hooks.intention);
  pass_on(prediction_, hooks.prediction);
  pass_on(plan_, hooks.plan);
  pass_on(safety_, hooks.safety);
  health_.take_each([this](const auto& health) { hear(health); });
  const double now_s = node_.clock().steady_s();
  for (auto& slot : slots_) slot.rate_hz = slot.meter.update(slot.stats->samples, now_s);
}

TopicFlow Listener::flow_of(const Slot& slot) const {
  const auto& stats = *slot.stats;
  TopicFlow flow;
  flow.topic = slot.topic;
  flow.wire = stats.topic;
  flow.rate_hz = slot.rate_hz;
  flow.age_s = stats.age_s();
  flow.writers = stats.peers;
  flow.samples = stats.samples;
  flow.incompatible_qos = stats.incompatible_qos;
  flow.rejected = stats.rejected;
  return flow;
}

Picture Listener::picture() {
  Picture p;
  p.vehicle = node_.options().names.vehicle;
  p.domain = node_.options().domain_id;
  p.now_s = node_.clock().now_s();
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
  for (const auto& slot : slots_) p.flows.push_back(flow_of(slot));
  for (const auto& endpoint : node_.foreign_endpoints()) p.foreign.push_back(sentence_of(endpoint));
  return p;
}

}  // namespace foretrack
