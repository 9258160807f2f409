// SPDX-License-Identifier: Apache-2.0
#include "services/ground_station/bus/bus.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <thread>

#include "services/common/topics.hpp"
#include "services/ground_station/bus/bus_warnings.hpp"
#include "services/ground_station/bus/contract.hpp"
#include "services/ground_station/schemas/schemas.hpp"

namespace foretrack::station {
namespace {

constexpr double kLookPeriod_s = 0.2;
constexpr double kLinger_s = 10.0;    // a channel whose writer left
constexpr double kRestAfter_s = 3.0;  // long enough to measure a rate
constexpr double kRestBytes_s = 1e6;
constexpr double kRejoinPeriod_s = 30.0;
constexpr std::size_t kMaxTopics = 2048;  // hostile discovery must not fill the memory
// Samples of many topics come together: one round for all of them costs less than one for each.
constexpr auto kRound = std::chrono::milliseconds(5);

std::string tool_name(const std::string& wire) {
  return wire.substr(2);  // "rt/uav1/odometry" is "/uav1/odometry" to ROS 2's tools
}

Channel channel_of(const std::string& wire, const SurveyedTopic& found, std::uint32_t id) {
  Channel c;
  c.id = id;
  c.topic = tool_name(wire);
  c.wire = wire;
  c.type = found.type;
  c.encoding = "cdr";
  c.schema_name = readable_type(found.type);
  if (const auto* schema = find_schema(found.type)) {
    c.schema_encoding = schema->encoding;
    c.schema = schema->text;
  }
  return c;
}

// Vehicles encode pictures while somebody reads them, and send them over their link.
bool is_made_when_read(const std::string& wire) {
  const ContractTopic* topic = contract_of(wire);
  return topic && (topic->name == topics::GroundImage::info.name ||
                   topic->name == topics::GroundVideo::info.name);
}

std::vector<std::string> names_of(const std::set<PeerId>& peers,
                                  const std::map<PeerId, std::string>& names) {
  std::vector<std::string> result;
  for (const auto& peer : peers)
    if (const auto it = names.find(peer); it != names.end()) result.push_back(it->second);
  std::sort(result.begin(), result.end());
  return result;
}

}  // namespace

Bus::Bus(std::shared_ptr<Node> node, Outlet outlet)
    : node_(std::move(node)), outlet_(std::move(outlet)) {}

Bus::~Bus() {
  for (auto& [name, topic] : topics_) stop_reading(topic);
}

void Bus::want(std::set<std::uint32_t> channels) {
  const std::lock_guard lock(mutex_);
  wanted_ = std::move(channels);
  look_soon_ = true;  // whoever begins to read waits for it
}

void Bus::expect_own(const std::string& wire) {
  const std::lock_guard lock(mutex_);
  own_.insert(wire);
}

void Bus::ask_to_rejoin(const std::string& why) {
  const std::lock_guard lock(mutex_);
  asked_to_rejoin_ = why;
}

std::vector<TopicReport> Bus::topics() const {
  const std::lock_guard lock(mutex_);
  return topic_reports_;
}

std::vector<VehicleReport> Bus::vehicles() const {
  const std::lock_guard lock(mutex_);
  return vehicle_reports_;
}

std::vector<std::string> Bus::warnings() const {
  const std::lock_guard lock(mutex_);
  return warnings_;
}

void Bus::stop_reading(Topic& topic) {
  if (!topic.reader) return;
  wait_.remove(*topic.reader);
  topic.reader.reset();
}

void Bus::open(const std::string& name, Topic& topic, double now_s) try {
  topic.reader = std::make_unique<RawReader>(
      *node_, RawTopic{name, topic.found.type, topic.found.keyed}, topic.found.profile);
  wait_.add(*topic.reader);
  topic.opened_s = now_s;
  topic.tells_clock = name.ends_with("/health");
  topic.resting = false;
  if (topic.open) return;
  if (topic.channel.type != topic.found.type)
    topic.channel = channel_of(name, topic.found, next_id_++);
  topic.channel.profile = topic.found.profile;
  topic.channel.latched = topic.channel.profile == "latched";
  topic.open = true;
  outlet_.opened(topic.channel);
} catch (const std::exception& error) {
  topic.refused = true;  // until discovery tells something new of it
  node_->report(error.what());
}

void Bus::close(Topic& topic) {
  stop_reading(topic);
  if (topic.open) outlet_.closed(topic.channel.id);
  topic.open = false;
}

void Bus::measure(Topic& topic, double now_s) {
  if (!topic.reader) return;
  topic.rate_hz = topic.sample_meter.update(topic.samples, now_s);
  topic.bytes_s = topic.byte_meter.update(topic.bytes, now_s);
}

void Bus::update(const std::string& name, Topic& topic, double now_s) {
  measure(topic, now_s);
  const bool wanted = wanted_now_.contains(topic.channel.id);
  if (topic.found.writers > 0) {
    topic.alone_s = -1.0;
    if (!topic.reader && !topic.refused && (!topic.resting || wanted)) open(name, topic, now_s);
  } else if (topic.alone_s < 0.0) {
    topic.alone_s = now_s;
  } else if (now_s - topic.alone_s > kLinger_s) {
    close(topic);
  }
  const bool rests_unread = topic.bytes_s > kRestBytes_s || is_made_when_read(name);
  if (topic.reader && !wanted && rests_unread && now_s - topic.opened_s > kRestAfter_s) {
    stop_reading(topic);
    hearing_.reset();  // of somebody it may be all that was heard
    topic.resting = true;
  }
}

void Bus::look(double now_s) {
  if (const auto news = node_->discoveries(); news != discoveries_) {
    discoveries_ = news;
    for (auto& [name, topic] : topics_) {  // who is still there is found again
      topic.found.writers = topic.found.readers = 0;
      topic.found.writing.clear(), topic.found.reading.clear();
      topic.found.qos_mismatch = false;
      topic.found.foreign_type.clear();
    }
    for (auto& [name, found] : survey(node_->endpoints())) {
      if (topics_.size() >= kMaxTopics && !topics_.contains(name)) continue;
      auto& topic = topics_[name];
      const bool changed = topic.found.type != found.type || topic.found.keyed != found.keyed;
      if (changed) close(topic);
      if (changed || std::string_view(topic.found.profile) != found.profile) stop_reading(topic);
      topic.found = found;
      topic.refused = false;
    }
  }
  std::set<std::string> own;
  {
    const std::lock_guard lock(mutex_);  // not while the outlet is called
    wanted_now_ = wanted_;
    own = own_;
  }
  for (auto& [name, topic] : topics_) {
    if (topic.found.writers == 0 && own.contains(name)) topic.found.writers = 1;
    update(name, topic, now_s);
  }
}

void Bus::take(double now_s) {
  batch_.clear();
  const auto log_time_ns = now_ns();
  PeerId from;
  for (auto& [name, topic] : topics_) {
    if (!topic.reader) continue;
    if (!spare_) spare_ = std::make_shared<Bytes>();
    while (topic.reader->take(*spare_, &from)) {
      hearing_.heard(from, now_s);
      ++topic.samples;
      topic.bytes += spare_->size();
      topic.last_s = now_s;
      if (topic.tells_clock)
        if (const auto ahead_s = clock_ahead_s(*spare_, log_time_ns)) topic.ahead_s = ahead_s;
      batch_.push_back({topic.channel.id, log_time_ns, std::move(spare_)});
      spare_ = std::make_shared<Bytes>();
    }
  }
  if (!batch_.empty()) outlet_.samples(batch_);
}

void Bus::publish(double now_s) {
  std::vector<TopicReport> topics;
  std::map<std::string, double> vehicles, clocks_ahead_s;
  std::map<PeerId, std::string> names;
  for (const auto& peer : node_->peers()) names[peer.id] = peer.name;
  for (const auto& [name, t] : topics_) {
    const auto& f = t.found;
    if (f.writers + f.readers == 0 && f.foreign_type.empty() && !t.open) continue;
    const std::string vehicle(vehicle_of(name));
    if (!vehicle.empty()) {
      auto& last_s = vehicles.try_emplace(vehicle, -1.0).first->second;
      last_s = std::max(last_s, t.last_s);
      if (t.ahead_s) clocks_ahead_s[vehicle] = *t.ahead_s;
    }
    topics.push_back({t.open ? t.channel.id : 0, tool_name(name), readable_type(t.found.type),
                      vehicle, t.found.writers, t.found.readers, t.rate_hz, t.bytes_s,
                      t.last_s < 0.0 ? -1.0 : now_s - t.last_s, t.resting, t.found.qos_mismatch,
                      t.found.foreign_type, names_of(f.writing, names),
                      names_of(f.reading, names)});
  }
  const std::lock_guard lock(mutex_);
  topic_reports_ = std::move(topics);
  warnings_ = warnings_of(*node_, clocks_ahead_s);
  vehicle_reports_.clear();
  for (const auto& [name, last_s] : vehicles) {
    VehicleReport report{name, last_s < 0.0 ? -1.0 : now_s - last_s, {}};
    if (const auto it = clocks_ahead_s.find(name); it != clocks_ahead_s.end())
      report.clock_ahead_s = it->second;
    vehicle_reports_.push_back(std::move(report));
  }
}

std::string Bus::reason_to_rejoin(double now_s) {
  std::string asked;
  {
    const std::lock_guard lock(mutex_);
    asked.swap(asked_to_rejoin_);
  }
  if (stood_still_s_ > 0.0)
    return fmt::format(
        "nothing was done for {:.1f} s, so that others may have dropped this participant",
        stood_still_s_);
  return asked.empty() ? hearing_.complaint(node_->peers(), now_s) : asked;
}

void Bus::heal(double now_s) {
  const double round_s = boot_s();
  if (round_s_ >= 0.0 && round_s - round_s_ > 0.5 * node_->lease_s())
    stood_still_s_ = round_s - round_s_;
  round_s_ = round_s;
  const auto why = reason_to_rejoin(now_s);
  if (now_s - rejoined_s_ < kRejoinPeriod_s) return;
  if (why.empty()) return;
  node_->report(why + ": joining the bus anew");
  rejoined_s_ = now_s;
  rejoin();
}

void Bus::rejoin() try {
  const auto node = std::make_shared<Node>(node_->options());
  for (auto& [name, topic] : topics_) {
    stop_reading(topic);
    topic.found.writers = topic.found.readers = 0;  // until they are discovered anew
  }
  node_ = node;
  discoveries_ = 0;
  stood_still_s_ = 0.0;
  hearing_.reset();
  if (on_rejoin) on_rejoin(node_);
} catch (const std::exception& error) {
  node_->report(error.what());
}

void Bus::run(Stop& stop) {
  double next_look_s = 0.0;
  while (!stop.requested()) {
    const double now_s = node_->clock().steady_s();
    if (now_s >= next_look_s || look_soon_.exchange(false)) {
      heal(now_s);
      look(now_s);
      publish(now_s);
      next_look_s = now_s + kLookPeriod_s;
    }
    take(now_s);
    std::this_thread::sleep_for(kRound);
    wait_.wait(std::max(0.0, next_look_s - node_->clock().steady_s()));
  }
}

}  // namespace foretrack::station
