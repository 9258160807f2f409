// SPDX-License-Identifier: Apache-2.0
#include "services/offline/flight/write_flight.hpp"

#include <fmt/format.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "core/prediction/intentions/intention_table.hpp"
#include "services/files/share/share.hpp"
#include "services/offline/flight/metrics_json.hpp"
#include "services/offline/flight/run_program.hpp"

namespace foretrack {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

void write_file(const fs::path& file, const std::string& text) {
  std::ofstream out(file, std::ios::binary);
  out << text;
  out.flush();
  if (!out) throw std::runtime_error("cannot write " + file.string());
}

Json json_of_point(const Vec3& p) {
  return {p.x(), p.y(), p.z()};
}

}  // namespace

std::string scenario_json_of(const FlightResult& flight, const MetricParams& params) {
  const World& world = flight.world;
  Json boxes = Json::array(), cylinders = Json::array(), turns = Json::array();
  Json intentions = Json::array();
  for (const IntentionRow& row : kIntentions)
    intentions.push_back({{"name", row.name}, {"color", fmt::format("#{:06x}", row.color_rgb)}});
  for (const auto& b : world.boxes)
    boxes.push_back({{"min_m", json_of_point(b.min_m)}, {"max_m", json_of_point(b.max_m)}});
  for (const auto& c : world.cylinders)
    cylinders.push_back({{"center_m", {c.center_m.x(), c.center_m.y()}},
                         {"radius_m", c.radius_m},
                         {"height_m", c.height_m}});
  for (const auto& turn : flight.metrics.turn_records)
    turns.push_back({{"begin_s", turn.event.begin_s}, {"success", turn.success}});
  const Json json = {{"name", flight.scenario.name},
                     {"seed", flight.scenario.seed},
                     {"map", to_string(flight.scenario.map)},
                     {"bounds_min_m", json_of_point(world.min_m)},
                     {"bounds_max_m", json_of_point(world.max_m)},
                     {"band_m", {params.band_low_m, params.band_high_m}},
                     {"near_m", params.near_m},
                     {"failure_rate", flight.metrics.failure_rate},
                     {"turns", turns},
                     {"intentions", intentions},
                     {"boxes", boxes},
                     {"cylinders", cylinders}};
  return json.dump(1) + "\n";
}

std::string write_flight(const FlightResult& flight, const MetricParams& params,
                         const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw std::runtime_error("cannot make " + folder.string() + ": " + error.message());
  const std::string log = csv_of(flight.rows);
  const std::string hash = sha256_of(log);
  write_file(folder / "log.csv", log);
  write_file(folder / "log.sha256", hash + "  log.csv\n");
  write_file(folder / "metrics.json", json_of(flight.metrics, hash));
  write_file(folder / "scenario.json", scenario_json_of(flight, params));
  return hash;
}

void plot_flight(const fs::path& folder) {
  const fs::path script = find_share("deploy/plot/plot_flight.py");
  const int status = run_program({"/usr/bin/python3", script.string(), folder.string()});
  if (status == 0) return;
  if (status == 3)
    throw std::runtime_error(
        "flight.png needs matplotlib: install python3-matplotlib (the flight's other files are "
        "written)");
  throw std::runtime_error("flight.png could not be drawn: /usr/bin/python3 " + script.string() +
                           " ended with " + std::to_string(status));
}

}  // namespace foretrack
