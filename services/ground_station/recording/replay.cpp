// SPDX-License-Identifier: Apache-2.0
#include "services/ground_station/recording/replay.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <span>
#include <stdexcept>
#include <string_view>
#include <thread>

#include "services/common/raw.hpp"
#include "services/ground_station/bus/contract.hpp"
#include "services/ground_station/mcap/reader.hpp"
#include "services/ground_station/schemas/schemas.hpp"

namespace foretrack::station {
namespace {

constexpr double kDiscovery_s = 1.0;  // before the first sample, so that readers hear it
constexpr double kRound_s = 0.02;     // the stop is heard so often

std::string value_of(const std::map<std::string, std::string>& map, const std::string& key) {
  const auto it = map.find(key);
  return it == map.end() ? "" : it->second;
}

// Of rosbag2, which has the names of ROS 2: "nav_msgs/msg/Odometry" →
// "nav_msgs::msg::dds_::Odometry_".
std::string dds_type_of(const std::string& schema_name) {
  const auto first = schema_name.find("/msg/");
  if (first == std::string::npos) return "";
  return schema_name.substr(0, first) + "::msg::dds_::" + schema_name.substr(first + 5) + "_";
}

// Of rosbag2's offered_qos_profiles, in which policies are numbers (older ones) or words.
std::string profile_of(const std::string& offered) {
  const auto says = [&offered](const char* what) {
    return offered.find(what) != std::string::npos;
  };
  if (offered.empty()) return "";
  if (says("durability: 1") || says("durability: transient_local")) return "latched";
  return says("reliability: 2") || says("reliability: best_effort") ? "sensor" : "state";
}

Channel channel_of(std::uint16_t id, const mcap::ChannelInfo& info) {
  Channel c;
  c.id = id + 1u;  // 0 is the station's own
  c.topic = info.topic;
  c.wire = value_of(info.metadata, "dds_topic");
  c.type = value_of(info.metadata, "dds_type");
  const bool of_rosbag = c.wire.empty() && info.topic.starts_with('/') && info.encoding == "cdr";
  if (of_rosbag && !dds_type_of(info.schema_name).empty()) {
    c.wire = "rt" + info.topic;
    c.type = dds_type_of(info.schema_name);
    c.profile = profile_of(value_of(info.metadata, "offered_qos_profiles"));
  }
  c.encoding = info.encoding;
  c.schema_name = info.schema_name;
  c.schema_encoding = info.schema_encoding;
  c.schema = info.schema;
  if (!of_rosbag) c.profile = value_of(info.metadata, "qos_profile");
  c.latched = c.profile == "latched";
  return c;
}

struct Recorded {
  Channel channel;
  RecordedType type = RecordedType::kUnknown;
};

// What is as today is shown to clients as live samples are.
Recorded recorded_of(std::uint16_t id, const mcap::ChannelInfo& info) {
  Recorded result{channel_of(id, info)};
  auto& c = result.channel;
  result.type = compare_recorded(c.type, value_of(info.metadata, "topic_type_hash"), c.schema);
  if (result.type != RecordedType::kSame) return result;
  const auto* live = find_schema(c.type);
  c.schema_name = live->name;
  c.schema_encoding = live->encoding;
  c.schema = live->text;
  return result;
}

// Empty: none is needed. Of types that are not ours the distribution of ROS 2 may be another one.
std::string version_warning(const Recorded& recorded, const mcap::Reader& reader) {
  if (recorded.type != RecordedType::kOlder && recorded.type != RecordedType::kOther) return {};
  const auto of_writer = reader.metadata().find("foretrack");
  const std::string by =
      of_writer == reader.metadata().end() ? "" : value_of(of_writer->second, "version");
  return fmt::format(
      "{} was recorded with another version of {}{}{}", recorded.channel.topic,
      readable_type(recorded.channel.type), by.empty() ? "" : ", by foretrack " + by,
      recorded.type == RecordedType::kOlder ? "; fields that came later read as zero" : "");
}

bool moves_vehicles(std::string_view topic) {
  return topic.ends_with("/mission/command") || topic.find("/fmu/in/") != std::string_view::npos;
}

/// When a sample of the recording is due, by the steady clock.
class Pace {
 public:
  Pace(double speed, double begin_s) : speed_(speed), begin_s_(begin_s) {}
  double due_s(std::uint64_t log_time_ns) {
    if (first_ns_ == 0) first_ns_ = log_time_ns;
    const auto since_ns = static_cast<double>(log_time_ns) - static_cast<double>(first_ns_);
    return begin_s_ + 1e-9 * since_ns / speed_;
  }

 private:
  double speed_, begin_s_;
  std::uint64_t first_ns_ = 0;
};

void sleep_until(double at_s, Stop& stop) {
  while (!stop.requested()) {
    const double left_s = at_s - steady_s();
    if (left_s <= 0.0) return;
    std::this_thread::sleep_for(std::chrono::duration<double>(std::min(left_s, kRound_s)));
  }
}

}  // namespace

Replay::Replay(const ReplayOptions& options, Outlet outlet)
    : options_(options), outlet_(std::move(outlet)) {
  check_recording(options_.file);
}

void check_recording(const std::filesystem::path& file) {
  mcap::Reader reader(file);
  if (reader.next()) return;
  throw std::runtime_error(file.string() + ": no message can be read: " +
                           (reader.fault().empty() ? "there are none in it" : reader.fault()));
}

void Replay::play(Stop& stop) {
  mcap::Reader reader(options_.file);
  Pace pace(options_.speed, steady_s());
  while (const auto message = reader.next()) {
    sleep_until(pace.due_s(message->log_time_ns), stop);
    if (stop.requested()) return;
    const std::uint32_t id = message->channel + 1u;
    const auto& info = reader.channels().at(message->channel);
    if (info.topic == "/station/status") continue;  // of the station that recorded it
    {
      const std::lock_guard lock(mutex_);
      auto& flow = flows_[id];
      if (flow.channel.topic.empty()) {
        const auto recorded = recorded_of(message->channel, info);
        flow.channel = recorded.channel;
        if (const auto text = version_warning(recorded, reader); !text.empty())
          warnings_.insert(text);
        outlet_.opened(flow.channel);
      }
      ++flow.samples;
      flow.bytes += message->data.size();
      flow.last_s = steady_s();
    }
    outlet_.samples({{id, static_cast<std::int64_t>(message->log_time_ns),
                      std::make_shared<const Bytes>(message->data.begin(), message->data.end())}});
  }
}

void Replay::run(Stop& stop) {
  do {
    play(stop);
  } while (options_.again && !stop.requested());
  while (!stop.requested()) sleep_until(steady_s() + 1.0, stop);
}

std::vector<TopicReport> Replay::topics() const {
  const double now_s = steady_s();
  std::vector<TopicReport> reports;
  const std::lock_guard lock(mutex_);
  for (auto& [id, flow] : flows_) {
    TopicReport report;
    report.channel = id;
    report.topic = flow.channel.topic;
    report.type = flow.channel.schema_name;
    report.vehicle = vehicle_of(flow.channel.wire);
    report.writers = 1;
    report.rate_hz = flow.sample_meter.update(flow.samples, now_s);
    report.bytes_s = flow.byte_meter.update(flow.bytes, now_s);
    report.age_s = now_s - flow.last_s;
    reports.push_back(std::move(report));
  }
  return reports;
}

std::vector<std::string> Replay::warnings() const {
  const std::lock_guard lock(mutex_);
  return {warnings_.begin(), warnings_.end()};
}

std::vector<VehicleReport> Replay::vehicles() const {
  std::map<std::string, double> ages;
  for (const auto& topic : topics())
    if (!topic.vehicle.empty()) {
      auto& age_s = ages.try_emplace(topic.vehicle, topic.age_s).first->second;
      age_s = std::min(age_s, topic.age_s);
    }
  std::vector<VehicleReport> reports;
  for (const auto& [name, age_s] : ages) reports.push_back({name, age_s, {}});
  return reports;
}

namespace {

/// A topic of the recording on the bus; null writer: it is left out.
struct OntoTopic {
  std::unique_ptr<RawWriter> writer;
  std::size_t padding = 0;  // zeros behind each sample, which fields that came later read
};

constexpr std::size_t kPadding = 256;

OntoTopic open_onto(const Recorded& recorded, bool with_commands, Node& node) {
  const auto& channel = recorded.channel;
  if (channel.wire.empty() || recorded.type == RecordedType::kOther ||
      (!with_commands && moves_vehicles(channel.wire)))
    return {};
  return {std::make_unique<RawWriter>(node, RawTopic{channel.wire, channel.type, false},
                                      channel.profile.empty() ? "state" : channel.profile.c_str()),
          recorded.type == RecordedType::kOlder ? kPadding : 0};
}

bool write_onto(OntoTopic& topic, std::span<const std::uint8_t> data) {
  if (!topic.writer) return false;
  CdrBytes sample(data.begin(), data.end());
  sample.resize(sample.size() + topic.padding);
  return topic.writer->write(sample);
}

}  // namespace

ReplayedOntoDds replay_onto_dds(const ReplayOntoDds& replay, Node& node, Stop& stop) {
  check_recording(replay.options.file);
  mcap::Reader reader(replay.options.file);
  std::map<std::uint16_t, OntoTopic> topics;
  ReplayedOntoDds done;
  Pace pace(replay.options.speed, steady_s() + kDiscovery_s);
  while (const auto message = reader.next()) {
    if (!topics.contains(message->channel)) {
      const auto recorded = recorded_of(message->channel, reader.channels().at(message->channel));
      topics[message->channel] = open_onto(recorded, replay.with_commands, node);
      auto text = version_warning(recorded, reader);
      if (recorded.type == RecordedType::kOther) text += "; it is left out";
      if (!text.empty()) done.warnings.push_back(std::move(text));
    }
    sleep_until(pace.due_s(message->log_time_ns), stop);
    if (stop.requested()) break;
    done.samples += write_onto(topics[message->channel], message->data);
  }
  done.fault = reader.fault();
  return done;
}

}  // namespace foretrack::station
