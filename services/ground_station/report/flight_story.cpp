// SPDX-License-Identifier: Apache-2.0
#include "services/ground_station/report/flight_story.hpp"

#include <algorithm>
#include <functional>
#include <map>
#include <stdexcept>

#include "services/common/raw.hpp"
#include "services/ground_station/bus/contract.hpp"
#include "services/ground_station/mcap/reader.hpp"
#include "services/ground_station/report/vehicle_teller.hpp"

namespace foretrack::station {
namespace {

using Take = std::function<void(double time_s, const CdrBytes& bytes)>;

/// What takes the samples of one type.
struct SampleKind {
  std::string_view topic;  // the vehicle's, or the autopilot's
  const char* type;
  std::function<Take(VehicleTeller&)> taker;
};

template <class Message>
SampleKind kind_of(std::string_view topic) {
  return {topic, TypeName<Message>::value, [](VehicleTeller& teller) -> Take {
            return [&teller, message = Message()](double time_s, const CdrBytes& bytes) mutable {
              if (from_cdr(type_ops<Message>(), bytes, &message)) teller.take(time_s, message);
            };
          }};
}

const std::vector<SampleKind>& sample_kinds() {
  namespace msg = foretrack_msgs::msg;
  static const std::vector<SampleKind> kKinds = {
      kind_of<nav_msgs::msg::Odometry>("odometry"),
      kind_of<msg::TargetState>("target/state"),
      kind_of<msg::SafetyState>("safety/state"),
      kind_of<msg::MissionCommand>("mission/command"),
      kind_of<msg::ServiceHealth>("health"),
      kind_of<msg::MovingBodies>("bodies"),
      kind_of<px4_msgs::msg::BatteryStatus>("fmu/out/battery_status"),
      kind_of<sensor_msgs::msg::CompressedImage>("camera/ground/image/compressed")};
  return kKinds;
}

/// Gives each sample to the teller of its vehicle.
class Reading {
 public:
  explicit Reading(const std::filesystem::path& file) : reader_(file) {
    story_.file = file.filename().string();
  }

  FlightStory read() {
    while (const auto message = reader_.next()) take(*message);
    story_.fault = reader_.fault();
    if (const auto about = reader_.metadata().find("foretrack");
        about != reader_.metadata().end()) {
      story_.version = value(about->second, "version");
      story_.host = value(about->second, "host");
    }
    for (auto& [name, teller] : tellers_) story_.vehicles.push_back(teller.finish());
    return std::move(story_);
  }

 private:
  static std::string value(const std::map<std::string, std::string>& pairs, const char* key) {
    const auto it = pairs.find(key);
    return it == pairs.end() ? "" : it->second;
  }

  void take(const mcap::Message& message) {
    const double time_s = 1e-9 * static_cast<double>(message.log_time_ns);
    story_.begin_s = story_.begin_s == 0.0 ? time_s : std::min(story_.begin_s, time_s);
    story_.end_s = std::max(story_.end_s, time_s);
    auto it = takers_.find(message.channel);
    if (it == takers_.end()) it = takers_.emplace(message.channel, taker_of(message.channel)).first;
    if (!it->second) return;
    bytes_.assign(message.data.begin(), message.data.end());
    it->second(time_s, bytes_);
  }

  // Empty: it is not told. The autopilot's topics are of the first vehicle, where there is but one.
  Take taker_of(std::uint16_t channel) {
    const auto& info = reader_.channels().at(channel);
    const std::string wire = value(info.metadata, "dds_topic");
    const std::string type = value(info.metadata, "dds_type");
    const bool is_autopilots = wire.starts_with("rt/fmu/");
    const std::string vehicle = is_autopilots && tellers_.size() == 1
                                    ? tellers_.begin()->first
                                    : std::string(vehicle_of(wire));
    if (vehicle.empty()) return {};
    for (const auto& [topic, type_name, taker] : sample_kinds())
      if (type == type_name && wire.ends_with("/" + std::string(topic)))
        return taker(tellers_.try_emplace(vehicle, vehicle).first->second);
    return {};
  }

  mcap::Reader reader_;
  FlightStory story_;
  std::map<std::string, VehicleTeller> tellers_;
  std::map<std::uint16_t, Take> takers_;
  CdrBytes bytes_;
};

}  // namespace

void Spread::add(double value) {
  ++count;
  sum += value;
  least = std::min(least, value);
  most = std::max(most, value);
}

FlightStory read_story(const std::filesystem::path& file) {
  FlightStory story = Reading(file).read();
  if (story.end_s == 0.0)
    throw std::runtime_error(file.string() + " holds no messages" +
                             (story.fault.empty() ? "" : ": " + story.fault));
  return story;
}

}  // namespace foretrack::station
