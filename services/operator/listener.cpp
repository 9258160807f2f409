// SPDX-License-Identifier: Apache-2.0
#include "services/operator/listener.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "services/common/presets.hpp"
#include "services/common/px4_releases.hpp"
#include "services/convert/color_image.hpp"
#include "services/convert/compressed_image.hpp"
#include "services/convert/px4.hpp"
#include "services/convert/target.hpp"
#include "services/convert/vehicle.hpp"
#include "services/operator/topic_watch.hpp"

namespace foretrack {
namespace {

constexpr double kForget_s = 0.02;      // of a clock that was set anew, a second
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

// One sentence a participant: all of its topics would say the same.
std::vector<std::string> other_versions(const Node& node) {
  std::map<PeerId, std::string> names, sentences;
  for (const auto& peer : node.peers()) names[peer.id] = peer.name;
  for (const auto& e : node.endpoints())
    if (!e.other_version.empty())
      sentences.try_emplace(e.peer,
                            fmt::format("{} on {}: {}", names[e.peer], e.topic, e.other_version));
  std::vector<std::string> result;
  for (const auto& [peer, sentence] : sentences) result.push_back(sentence);
  return result;
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
      px4_status_(node),
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
  watch(px4_status_);
  if (with_images) {
    Cameras& cameras = cameras_.emplace(node);
    watch(cameras.color);
    watch(cameras.compressed);
    watch(cameras.color_info);
    watch(cameras.depth);
    watch(cameras.depth_info);
    watch(cameras.map);
  } else {
    color_info_.emplace(node);
  }
  watch(target_.reader);
  watch(intention_.reader);
  watch(prediction_.reader);
  watch(plan_.reader);
  watch(safety_.reader);
}

void Listener::hear(const foretrack_msgs::msg::ServiceHealth& health) {
  const bool first = !services_.contains(health.service().c_str());
  auto& heard = services_[health.service().c_str()];
  heard.report.health = health;
  heard.at_s = node_.clock().steady_s();
  const double stamp_s = to_seconds(health.header().stamp());
  const double now_s = stamp_s < kNoWallClock_s ? simulated_s_ : node_.clock().now_s();
  if (now_s < 0.0) return;
  // On its way a stamp only grows older: the youngest of the last ones tells most.
  const double before_s = first ? stamp_s - now_s : heard.report.clock_ahead_s - kForget_s;
  heard.report.clock_ahead_s = std::max(stamp_s - now_s, before_s);
}

template <class Topic, class Convert, class Take>
void Listener::take_as(Reader<Topic>& reader, Convert convert, Take take) {
  reader.take_each_as(
      [&](auto&& message) {
        auto value = convert(message);
        if (!value) refusals_[reader.stats().topic] = value.fault().text;
        return value;
      },
      take);
}

// As the services do, so that what they refuse is not taken for good.
void Listener::take_inputs() {
  const Names& names = node_.options().names;
  // Where the map's frame is, only the services know: whatever frame it names may be transformed.
  const OdometryFrames frames{names.body_frame, true};
  odometry_.reader.take_each_as(
      [&](nav_msgs::msg::Odometry&& message) {
        auto value = from_idl(message, frames);
        if (value) {
          odometry_.sample = std::move(message);
          odometry_.any = true;
        } else {
          refusals_[odometry_.reader.stats().topic] = value.fault().text;
        }
        return value;
      },
      [](const VehicleState&) {});
  take_as(
      observation_,
      [this](const foretrack_msgs::msg::TargetObservation& message) -> Converted<bool> {
        nobody_in_images_ = sees_nobody(message);
        if (nobody_in_images_) return true;
        const auto value = from_idl(message);
        if (!value) return value.fault();
        return true;
      },
      [](bool) {});
  take_as(
      px4_status_, [](const px4_msgs::msg::VehicleStatus& message) { return from_idl(message); },
      [this](const AutopilotStatus& status) {
        const double now_s = simulated_s_ >= 0.0 ? simulated_s_ : node_.clock().now_s();
        px4_ahead_s_ = status.stamp_s - now_s;
      });
}

void Listener::take_images(Cameras& c) {
  const auto camera = [](const sensor_msgs::msg::CameraInfo& message) { return from_idl(message); };
  take_as(
      c.color_info,
      [&](const sensor_msgs::msg::CameraInfo& message) {
        if (hooks.color_image) hooks.color_image(to_seconds(message.header().stamp()));
        return camera(message);
      },
      [&](const CameraWithLens& info) { c.color_camera = info; });
  take_as(c.depth_info, camera, [&](const CameraWithLens& info) { c.depth_camera = info; });
  // Before its camera_info comes, an image is of no use, and no fault of its own.
  if (c.color_camera) {
    const auto pixels = [&](const auto& message) {
      return rgb_from_idl(message, c.color_camera->camera);
    };
    take_as(c.color, pixels, [](const RgbImage&) {});
    take_as(c.compressed, pixels, [](const RgbImage&) {});
  } else {
    c.color.take_newest();
    c.compressed.take_newest();
  }
  if (c.depth_camera)
    take_as(
        c.depth,
        [&](const sensor_msgs::msg::Image& message) {
          return from_idl(message, c.depth_camera->camera);
        },
        [](const DepthImage&) {});
  else
    c.depth.take_newest();
  if (const auto* map = c.map.take_newest())
    map_is_static_ = to_seconds(map->header().stamp()) == 0.0;
}

void Listener::update() {
  if (const auto* clock = simulated_clock_.take_newest()) simulated_s_ = to_seconds(clock->clock());
  vehicle_truth_.take(hooks.vehicle_truth);
  target_truth_.take(hooks.target_truth);
  take_inputs();
  if (color_info_)
    color_info_->take_each([this](const auto& info) {
      if (hooks.color_image) hooks.color_image(to_seconds(info.header().stamp()));
    });
  if (cameras_) take_images(*cameras_);
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

void Listener::fill_inputs(FlightSnapshot& p) const {
  const Names& names = node_.options().names;
  std::vector<std::string> topics;
  for (const auto& endpoint : node_.endpoints()) {
    if (!endpoint.writes) continue;
    p.published.emplace_back(endpoint.topic, endpoint.type);
    topics.push_back(endpoint.topic);
  }
  p.simulated = services_.contains("simulator");
  p.nobody_in_images = nobody_in_images_;
  p.px4_release = names.px4_release.empty() ? kPx4ReleaseOfIdl : names.px4_release;
  p.px4_spoken = px4_release_of(topics, names.px4_namespace);
  p.px4_ahead_s = px4_ahead_s_;
  for (const auto preset : presets_that_fit(topics)) {
    Names with = names;
    add_preset(with, preset);
    if (with.remaps != names.remaps) p.fitting_presets.push_back(preset);
  }
  for (auto& flow : p.flows)
    if (const auto it = refusals_.find(flow.wire); it != refusals_.end()) flow.refusal = it->second;
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
  fill_inputs(p);
  p.clocks = simulated_clock_.writers();
  p.other_versions = other_versions(node_);
  for (const auto& endpoint : node_.foreign_endpoints()) p.foreign.push_back(sentence_of(endpoint));
  return p;
}

}  // namespace foretrack
