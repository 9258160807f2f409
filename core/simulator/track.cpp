// SPDX-License-Identifier: Apache-2.0
#include "core/simulator/track.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <optional>
#include <stdexcept>

namespace foretrack {
namespace {

constexpr std::string_view kBlanks = " \t\r,;";
constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
constexpr double kUsualRate_hz = 25.0;
constexpr double kWalk_m_s = 1.3;
constexpr double kMostFast = 0.1;  // of the steps: more is no accident
constexpr double kLeastRate_hz = 1.0;

/// Where in a row what stands.
struct Columns {
  std::size_t frame = 0, id = 1, x = 2, y = 3;
  std::size_t count = 4;
};

Columns columns_of(TrackFormat format) {
  if (format == TrackFormat::kOpenTraj) return {.frame = 0, .id = 1, .x = 2, .y = 4, .count = 8};
  if (format == TrackFormat::kIdFrameXy) return {.frame = 1, .id = 0};
  return {};
}

// Where the error is, and what the rows should look like.
struct FilePlace {
  const std::string& file_name;
  TrackFormat format;
  int line = 0;
  [[noreturn]] void fail(const std::string& what) const {
    const char* row = format == TrackFormat::kOpenTraj    ? "frame id x z y vx vz vy"
                      : format == TrackFormat::kIdFrameXy ? "id frame x y"
                                                          : "frame id x y";
    throw std::invalid_argument(file_name + ":" + std::to_string(line) + ": " + what +
                                "; a row is '" + row + "'");
  }
};

std::vector<std::string_view> words_of(std::string_view row) {
  std::vector<std::string_view> words;
  for (std::size_t at = row.find_first_not_of(kBlanks); at != std::string_view::npos;
       at = row.find_first_not_of(kBlanks, at)) {
    const std::size_t end = std::min(row.find_first_of(kBlanks, at), row.size());
    words.push_back(row.substr(at, end - at));
    at = end;
  }
  return words;
}

std::optional<double> number_of(std::string_view word) {
  double value = 0.0;
  const auto [last, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc() || last != word.data() + word.size() || !std::isfinite(value))
    return std::nullopt;
  return value;
}

std::vector<double> numbers_of(std::string_view row, const FilePlace& place) {
  std::vector<double> numbers;
  for (const std::string_view word : words_of(row)) {
    const auto value = number_of(word);
    if (!value) place.fail(std::string(word) + " is not a number");
    numbers.push_back(*value);
  }
  return numbers;
}

// What else a row may have, which is not read.
bool is_further_column(std::string_view word) {
  return word == "z" || word == "vx" || word == "vy" || word == "vz";
}

// "id frame x y z": names of columns, in a comment or alone in the first row.
std::optional<Columns> columns_named(std::string_view line) {
  const auto words = words_of(line.substr(line.starts_with('#') ? 1 : 0));
  const auto at = [&words](std::string_view name) {
    const auto found = std::find(words.begin(), words.end(), name);
    return static_cast<std::size_t>(found - words.begin());
  };
  Columns columns{at("frame"), at("id"), at("x"), at("y"), 4};
  if (std::max({columns.frame, columns.id, columns.x, columns.y}) >= words.size())
    return std::nullopt;
  while (columns.count < words.size() && is_further_column(words[columns.count])) ++columns.count;
  return columns;
}

// "framerate: 25": 0 if it does not say.
double rate_named(std::string_view line) {
  const auto words = words_of(line.substr(line.starts_with('#') ? 1 : 0));
  if (words.size() < 2 || (words[0] != "framerate:" && words[0] != "framerate")) return 0.0;
  return number_of(words[1]).value_or(0.0);
}

int whole(double value, const char* name, const FilePlace& place) {
  if (value != std::floor(value) || std::abs(value) > 1e9)
    place.fail(std::string(name) + " " + std::to_string(value) + " is not a whole number");
  return static_cast<int>(value);
}

std::string rounded(double value) {
  std::string text = std::to_string(value);
  text.resize(text.find('.') + (value < 10.0 ? 3 : 2));
  return text;
}

double step_m(const Track& track, std::size_t i) {
  return (track.points[i].position_m - track.points[i - 1].position_m).norm();
}
double step_m_s(const Track& track, std::size_t i) {
  return step_m(track, i) / (track.points[i].time_s - track.points[i - 1].time_s);
}

// All speeds of the file, sorted.
std::vector<double> speeds_of(const std::vector<Track>& tracks) {
  std::vector<double> speeds;
  for (const Track& track : tracks)
    for (std::size_t i = 1; i < track.points.size(); ++i) speeds.push_back(step_m_s(track, i));
  std::sort(speeds.begin(), speeds.end());
  return speeds;
}

bool too_fast(const std::vector<double>& speeds) {
  const auto first = std::upper_bound(speeds.begin(), speeds.end(), kFastestPerson_m_s);
  return static_cast<double>(speeds.end() - first) > kMostFast * static_cast<double>(speeds.size());
}

/// Rows that may be read one way or another.
struct Rows {
  struct Row {
    int line, frame, id;
    Vec2 position_m;
  };
  std::vector<Row> rows;

  // Throws if the frames of a pedestrian do not increase.
  std::vector<Track> tracks(double rate_hz, FilePlace place) const {
    std::map<int, Track> by_id;
    for (const Row& row : rows) {
      Track& track = by_id[row.id];
      track.pedestrian = row.id;
      place.line = row.line;
      const double time_s = (row.frame - rows.front().frame) / rate_hz;
      if (!track.points.empty() && time_s <= track.points.back().time_s)
        place.fail("the frames of pedestrian " + std::to_string(row.id) + " do not increase");
      track.points.push_back({time_s, row.position_m});
      track.lines.push_back(row.line);
    }
    std::vector<Track> result;
    for (auto& [id, track] : by_id) result.push_back(std::move(track));
    return result;
  }
  Rows with_frame_and_id_swapped() const {
    Rows swapped = *this;
    for (Row& row : swapped.rows) std::swap(row.frame, row.id);
    return swapped;
  }
};

// Most of the file is faster than anybody: why?
std::string likely_cause(const Rows& rows, const std::vector<double>& speeds, double rate_hz,
                         const FilePlace& place) {
  try {
    const auto swapped = speeds_of(rows.with_frame_and_id_swapped().tracks(rate_hz, place));
    if (!swapped.empty() && !too_fast(swapped))
      return "the columns look like 'id frame x y' (format: id_frame_xy)";
  } catch (const std::invalid_argument&) {  // they are not that, either
  }
  const double usual_m_s = speeds[speeds.size() / 2];
  const double walking_hz = rate_hz * kWalk_m_s / usual_m_s;
  std::string cause = "are they metres, not pixels?";
  if (walking_hz >= kLeastRate_hz)
    cause = "is the rate right? At " + rounded(walking_hz) + " frames a second, instead of " +
            rounded(rate_hz) + ", people would walk; or " + cause;
  return cause;
}

// Their ids, runs as "3–9".
std::string runs_of(const std::vector<Track>& tracks) {
  std::string text;
  for (std::size_t i = 0; i < tracks.size(); ++i) {
    const std::size_t first = i;
    while (i + 1 < tracks.size() && tracks[i + 1].pedestrian == tracks[i].pedestrian + 1) ++i;
    text.append(text.empty() ? "" : ", ").append(std::to_string(tracks[first].pedestrian));
    if (i > first) text.append("–").append(std::to_string(tracks[i].pedestrian));
  }
  return text;
}

}  // namespace

std::vector<Track> parse_tracks(std::string_view text, TrackFormat format, double rate_hz,
                                const std::string& file_name) {
  if (!(rate_hz >= 0.0)) throw std::invalid_argument(file_name + ": rate_hz must be above 0");
  Columns columns = columns_of(format);
  Rows rows;
  double said_hz = 0.0;
  FilePlace place{file_name, format};
  if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    ++place.line;
    if (rows.rows.empty()) {
      said_hz = std::max(said_hz, rate_named(line));
      const auto named = columns_named(line);
      if (named && format != TrackFormat::kOpenTraj) columns = *named;
      if (named) continue;
    }
    const auto row = numbers_of(line.substr(0, line.find('#')), place);
    if (row.empty()) continue;
    if (row.size() != columns.count) place.fail("found " + std::to_string(row.size()) + " columns");
    rows.rows.push_back({place.line,
                         whole(row[columns.frame], "frame", place),
                         whole(row[columns.id], "id", place),
                         {row[columns.x], row[columns.y]}});
  }
  if (rows.rows.empty()) place.fail("no rows");
  if (rate_hz == 0.0) rate_hz = said_hz > 0.0 ? said_hz : kUsualRate_hz;
  auto tracks = rows.tracks(rate_hz, place);
  if (const auto speeds = speeds_of(tracks); too_fast(speeds))
    throw std::invalid_argument(
        file_name + ": people would move at " + rounded(speeds[speeds.size() / 2]) +
        " m/s, the fastest at " + rounded(speeds.back()) + "; nobody is faster than " +
        rounded(kFastestPerson_m_s) + " m/s: " + likely_cause(rows, speeds, rate_hz, place));
  return tracks;
}

const Track& track_of(const std::vector<Track>& tracks, int pedestrian,
                      const std::string& file_name) {
  for (const auto& track : tracks) {
    if (track.pedestrian != pedestrian) continue;
    for (std::size_t i = 1; i < track.points.size(); ++i)
      if (step_m_s(track, i) > kFastestPerson_m_s)
        throw std::invalid_argument(file_name + ":" + std::to_string(track.lines[i]) +
                                    ": pedestrian " + std::to_string(pedestrian) + " jumps " +
                                    rounded(step_m(track, i)) + " m there, at " +
                                    rounded(step_m_s(track, i)) + " m/s; nobody is faster than " +
                                    rounded(kFastestPerson_m_s) + " m/s");
    return track;
  }
  throw std::invalid_argument(file_name + ": no pedestrian " + std::to_string(pedestrian) +
                              "; there are " + runs_of(tracks));
}

Eigen::AlignedBox2d bounds_of(std::span<const TrackPoint> points) {
  Eigen::AlignedBox2d bounds;
  for (const TrackPoint& point : points) bounds.extend(point.position_m);
  return bounds;
}

}  // namespace foretrack
