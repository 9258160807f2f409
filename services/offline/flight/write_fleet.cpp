// SPDX-License-Identifier: Apache-2.0
#include "services/offline/flight/write_fleet.hpp"

#include <fmt/format.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "services/offline/flight/metrics_json.hpp"

namespace foretrack {
namespace {

using Json = nlohmann::ordered_json;

Json json_of(const FleetMetrics& m) {
  Json events = Json::array();
  for (const FleetEvent& event : m.events)
    events.push_back({{"begin_s", event.begin_s}, {"longest_unseen_s", event.longest_unseen_s}});
  return {{"vehicles", m.vehicles},
          {"union_visibility", m.union_visibility},
          {"k2_visibility", m.k2_visibility},
          {"longest_unseen_s", m.longest_unseen_s},
          {"band_share", m.band_share},
          {"mutual_occlusion", m.mutual_occlusion},
          {"min_separation_m", finite_json(m.min_separation_m)},
          {"below_separation_s", m.below_separation_s},
          {"contacts", m.contacts},
          {"wall_contacts", m.wall_contacts},
          {"person_contacts", m.person_contacts},
          {"stacked_s", m.stacked_s},
          {"separation_score", m.separation_score},
          {"handovers", m.handovers},
          {"bytes_per_s", m.bytes_per_s},
          {"events", events}};
}

}  // namespace

std::string json_of(const FleetFlight& flight) {
  Json vehicles = Json::object();
  for (std::size_t i = 0; i < flight.names.size(); ++i)
    vehicles[flight.names[i]] = Json::parse(json_of(flight.vehicles[i].metrics));
  return Json{{"fleet", json_of(flight.metrics)}, {"vehicles", vehicles}}.dump(1) + "\n";
}

std::string to_text(const FleetFlight& flight) {
  std::string text;
  const auto add = [&text]<class... Args>(fmt::format_string<Args...> format, Args&&... args) {
    text += fmt::format(format, std::forward<Args>(args)...);
  };
  const FleetMetrics& m = flight.metrics;
  add("seen by one       {:6.2f} %  of the time; by two {:.2f} %; by nobody for {:.2f} s at most\n",
      100.0 * m.union_visibility, 100.0 * m.k2_visibility, m.longest_unseen_s);
  add("separation        {:6.2f} m least, below the promise for {:.2f} s, {} contacts\n",
      m.min_separation_m, m.below_separation_s, m.contacts);
  add("one in the band   {:6.2f} %  of the time, {} handovers\n", 100.0 * m.band_share,
      m.handovers);
  add("in the way        {:6.2f} %  of the time a vehicle hides the person from another\n",
      100.0 * m.mutual_occlusion);
  add("told              {:6.1f} kB/s by each\n", 0.001 * m.bytes_per_s);
  for (std::size_t i = 0; i < flight.names.size(); ++i) {
    const Metrics& v = flight.vehicles[i].metrics;
    add("{:<18}sees {:.1f} %, {:.2f} m away on average, {} collisions, {} contacts with people\n",
        flight.names[i], 100.0 * (1.0 - v.fov_loss_rate), v.mean_distance_m, v.collisions,
        v.person_contacts);
  }
  return text;
}

void write_fleet_flight(const FleetFlight& flight, const MetricParams& params,
                        const std::filesystem::path& folder) {
  for (std::size_t i = 0; i < flight.names.size(); ++i)
    if (!flight.vehicles[i].rows.empty())  // it was there
      write_flight(flight.vehicles[i], params, folder / flight.names[i]);
  std::ofstream out(folder / "metrics.json", std::ios::binary);
  out << json_of(flight);
  out.flush();
  if (!out) throw std::runtime_error("cannot write " + (folder / "metrics.json").string());
}

}  // namespace foretrack
