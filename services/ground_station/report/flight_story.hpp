// SPDX-License-Identifier: Apache-2.0
// What happened in a recording, for people to read.
#pragma once

#include <cstdint>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace foretrack::station {

/// Times are log times, in seconds since 1970; positions are in the world frame, metres.
struct StoryPoint {
  double time_s = 0.0;
  double x_m = 0.0, y_m = 0.0, z_m = 0.0;
};

/// Something that was ordered, decided or said.
struct StoryEvent {
  enum class Kind { kOrder, kMode, kMission, kAlarm, kService, kPerson };
  double time_s = 0.0;
  Kind kind = Kind::kMission;
  bool bad = false;
  std::string text;
};

/// A time in which the person was lost.
struct StoryLoss {
  double from_s = 0.0;                // last seen
  std::optional<double> to_s;         // seen again; none: not in this recording
  std::optional<StoryPoint> where;    // of the person, as it was thought at from_s
  std::vector<std::uint8_t> picture;  // JPEG, the last before from_s; empty: none was recorded
  std::vector<std::uint8_t> found;    // the same at to_s
};

/// Of values that come one by one.
struct Spread {
  std::size_t count = 0;
  double least = std::numeric_limits<double>::infinity();
  double most = -std::numeric_limits<double>::infinity();
  double sum = 0.0;
  void add(double value);
  double mean() const { return sum / static_cast<double>(count); }
};

struct VehicleStory {
  std::string name;
  double flown_m = 0.0;    // along its way
  double armed_s = 0.0;    // together
  double tracked_s = 0.0;  // in which the gate flew a checked plan
  double seen_s = 0.0;     // in which the person was tracked
  Spread distance_m;       // to the person, horizontally, while they were tracked
  Spread speed_m_s, altitude_m;
  Spread others_m;  // to anybody else who was known, horizontally, middle to middle
  std::optional<double> battery_begin, battery_end;  // of a full one
  std::vector<StoryPoint> track, person;             // a point each quarter of a metre
  std::vector<StoryLoss> losses;
  std::vector<StoryEvent> events;  // in the order of time
};

struct FlightStory {
  std::string file;
  std::string version, host;  // that recorded it
  std::string fault;          // why the file ended before its end; empty: it did not
  double begin_s = 0.0, end_s = 0.0;
  std::vector<VehicleStory> vehicles;  // in the order of their names
};

/// Reads the whole recording of a station. Messages of other types than ours are passed over, and
/// so is what cannot be decoded. Throws std::runtime_error that names the file if it holds nothing.
/// Memory: what the story holds. Cost: about a second for each 300 MB.
FlightStory read_story(const std::filesystem::path& file);

}  // namespace foretrack::station
