// SPDX-License-Identifier: Apache-2.0
#include "services/offline/experiments/flight_job.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "services/files/config/load_params.hpp"
#include "services/files/share/share.hpp"

namespace foretrack {
namespace {

namespace fs = std::filesystem;

constexpr double kShortestWalk_s = 4.0;  // of a recorded pedestrian
constexpr std::string_view kShippedTracks = "deploy/scenarios/tracks/plaza.xy";

// One walk of real_tracks, or one seed of the others.
struct Run {
  std::string world;
  ScenarioOverrides overrides;
};

std::string quoted(const std::string& text) {
  return text.find_first_of(" '\"$&;()*?[]<>|\\") == std::string::npos ? text : "'" + text + "'";
}

std::string command_of(const Run& run, const std::string& params) {
  const ScenarioOverrides& o = run.overrides;
  std::string text = fmt::format("foretrack fly --scenario {} --seed {} --map {} --for {:g}",
                                 quoted(run.world), *o.seed, to_string(*o.map), *o.duration_s);
  if (o.track_file)
    text += fmt::format(" --track {} --pedestrian {}", quoted(*o.track_file), *o.pedestrian);
  if (o.track_rate_hz) text += fmt::format(" --track-rate {:g}", *o.track_rate_hz);
  for (const auto& setting : o.settings) text += " --set " + quoted(setting);
  return text + " --params " + quoted(params) + " --out flights/replay";
}

std::string text_of(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) throw std::invalid_argument(fmt::format("{}: cannot be read", file));
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

bool is_xy(const std::string& file) {
  return file.ends_with(".xy") || file.ends_with(".csv");
}

class Listing {
 public:
  explicit Listing(const BenchRequest& request) : request_(request) {
    for (const auto& method : request.methods) load_params(find_params(method));
  }

  std::vector<FlightJob> run() {
    for (const Experiment& experiment : request_.experiments)
      for (const Condition& condition : experiment.conditions)
        for (const MapSource map : request_.maps)
          for (const double speed_m_s : speeds_of(experiment))
            add(experiment, condition, map, speed_m_s);
    return std::move(jobs_);
  }

 private:
  std::vector<double> speeds_of(const Experiment& e) const {
    if (e.event == EventKind::kWalk) return {0.0};
    if (!request_.speeds_m_s.empty()) return request_.speeds_m_s;
    if (!request_.scenario_files.empty() || e.speeds_m_s.empty()) return {0.0};
    return request_.quick && !e.quick_speeds_m_s.empty() ? e.quick_speeds_m_s : e.speeds_m_s;
  }
  std::uint64_t first_seed_of(const Experiment& e) const {
    return request_.seed > 0 ? request_.seed : e.first_seed;
  }

  void add(const Experiment& e, const Condition& condition, MapSource map, double speed_m_s) {
    const auto runs = runs_of(e, condition, map, speed_m_s);
    const int first_pair = pairs_;
    pairs_ += static_cast<int>(runs.size());
    for (const auto& method : request_.methods)
      for (std::size_t i = 0; i < runs.size(); ++i) {
        FlightJob& job = jobs_.emplace_back();
        job.cell = {condition.name.empty() ? e.name : e.name + "/" + condition.name,
                    fs::path(method).stem().string(), map, speed_m_s};
        job.event = e.event;
        job.world = runs[i].world;
        job.overrides = runs[i].overrides;
        job.params = find_params(method);
        job.command = command_of(runs[i], method);
        job.pair = first_pair + static_cast<int>(i);
      }
  }

  std::vector<Run> runs_of(const Experiment& e, const Condition& condition, MapSource map,
                           double speed_m_s) const {
    std::vector<Run> runs = e.event == EventKind::kWalk ? walks_of(e) : seeds_of(e);
    for (Run& run : runs) {
      run.overrides.map = map;
      run.overrides.settings = condition.settings;
      if (speed_m_s > 0.0)
        run.overrides.settings.push_back(fmt::format("target.speed_m_s={:g}", speed_m_s));
      check(run);
    }
    return runs;
  }

  // A scenario that cannot be is found before anything is flown.
  void check(const Run& run) const { load_scenario(run.world, run.overrides); }

  int count_of(const Experiment& e) const {
    if (request_.runs > 0) return request_.runs;
    return request_.quick ? e.quick_runs : e.runs;
  }

  std::vector<Run> seeds_of(const Experiment& e) const {
    std::vector<Run> runs;
    const auto& files = request_.scenario_files;
    for (const auto& world : files.empty() ? e.worlds : files)
      for (int i = 0; i < count_of(e); ++i) {
        Run& run = runs.emplace_back();
        run.world = world;
        run.overrides.seed = first_seed_of(e) + static_cast<std::uint64_t>(i);
        run.overrides.duration_s = request_.quick ? e.quick_duration_s : e.duration_s;
        if (!files.empty()) run.overrides.duration_s = load_scenario(world).duration_s;
      }
    return runs;
  }

  std::vector<Run> walks_of(const Experiment& e) const {
    std::vector<std::string> files = request_.track_files;
    if (files.empty()) files = {find_share(kShippedTracks).string()};
    std::vector<Run> runs;
    for (const auto& file : files) {
      const auto format = is_xy(file) ? TrackFormat::kFrameIdXy : TrackFormat::kOpenTraj;
      const auto tracks = parse_tracks(text_of(file), format, request_.track_rate_hz, file);
      for (const Track& track : tracks) {
        if (track.points.size() < 2) continue;
        const double walk_s = track.points.back().time_s - track.points.front().time_s;
        if (walk_s < kShortestWalk_s) continue;
        if (count_of(e) > 0 && static_cast<int>(runs.size()) >= count_of(e)) return runs;
        Run& run = runs.emplace_back();
        run.world = e.worlds.front();
        run.overrides.seed = first_seed_of(e) + runs.size() - 1;
        // The walk begins when the person has stood for start_s.
        run.overrides.duration_s = std::floor(walk_s * 10.0) / 10.0 + 1.5;
        run.overrides.track_file = file;
        run.overrides.pedestrian = track.pedestrian;
        if (request_.track_rate_hz > 0.0) run.overrides.track_rate_hz = request_.track_rate_hz;
      }
    }
    return runs;
  }

  const BenchRequest& request_;
  std::vector<FlightJob> jobs_;
  int pairs_ = 0;
};

}  // namespace

std::vector<FlightJob> list_jobs(const BenchRequest& request) {
  return Listing(request).run();
}

}  // namespace foretrack
