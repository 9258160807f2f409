// SPDX-License-Identifier: Apache-2.0
#include "core/simulator/track.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <stdexcept>

namespace foretrack {
namespace {

constexpr std::string_view kBlanks = " \t\r,";

// Where the error is, and what the rows should look like.
struct FilePlace {
  const std::string& file_name;
  TrackFormat format;
  int line = 0;
  [[noreturn]] void fail(const std::string& what) const {
    const char* row = format == TrackFormat::kOpenTraj ? "frame id x z y vx vz vy" : "frame id x y";
    throw std::invalid_argument(file_name + ":" + std::to_string(line) + ": " + what +
                                "; a row is '" + row + "'");
  }
};

std::vector<double> numbers_of(std::string_view row, const FilePlace& place) {
  std::vector<double> numbers;
  for (std::size_t at = row.find_first_not_of(kBlanks); at != std::string_view::npos;
       at = row.find_first_not_of(kBlanks, at)) {
    const std::size_t end = std::min(row.find_first_of(kBlanks, at), row.size());
    const std::string_view word = row.substr(at, end - at);
    double value = 0.0;
    const auto [last, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc() || last != word.data() + word.size() || !std::isfinite(value))
      place.fail(std::string(word) + " is not a number");
    numbers.push_back(value);
    at = end;
  }
  return numbers;
}

int whole(double value, const char* name, const FilePlace& place) {
  if (value != std::floor(value) || std::abs(value) > 1e9)
    place.fail(std::string(name) + " " + std::to_string(value) + " is not a whole number");
  return static_cast<int>(value);
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
  if (!(rate_hz > 0.0)) throw std::invalid_argument(file_name + ": rate_hz must be above 0");
  const std::size_t columns = format == TrackFormat::kOpenTraj ? 8 : 4;
  std::map<int, std::vector<TrackPoint>> by_id;
  FilePlace place{file_name, format};
  double first_frame = std::nan("");
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    ++place.line;
    const auto row = numbers_of(line.substr(0, line.find('#')), place);
    if (row.empty()) continue;
    if (row.size() != columns) place.fail("found " + std::to_string(row.size()) + " columns");
    if (std::isnan(first_frame)) first_frame = row[0];
    const double time_s = (whole(row[0], "frame", place) - first_frame) / rate_hz;
    auto& points = by_id[whole(row[1], "id", place)];
    if (!points.empty() && time_s <= points.back().time_s)
      place.fail("the frames of pedestrian " + std::to_string(static_cast<int>(row[1])) +
                 " do not increase");
    points.push_back({time_s, {row[2], format == TrackFormat::kOpenTraj ? row[4] : row[3]}});
  }
  if (by_id.empty()) place.fail("no rows");
  std::vector<Track> tracks;
  for (auto& [id, points] : by_id) tracks.push_back({id, std::move(points)});
  return tracks;
}

const Track& track_of(const std::vector<Track>& tracks, int pedestrian,
                      const std::string& file_name) {
  for (const auto& track : tracks)
    if (track.pedestrian == pedestrian) return track;
  throw std::invalid_argument(file_name + ": no pedestrian " + std::to_string(pedestrian) +
                              "; there are " + runs_of(tracks));
}

Eigen::AlignedBox2d bounds_of(std::span<const TrackPoint> points) {
  Eigen::AlignedBox2d bounds;
  for (const TrackPoint& point : points) bounds.extend(point.position_m);
  return bounds;
}

}  // namespace foretrack
