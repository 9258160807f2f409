// SPDX-License-Identifier: Apache-2.0
#include "services/offline/experiments/summary_json.hpp"

#include <nlohmann/json.hpp>

#include "services/offline/flight/metrics_json.hpp"

namespace foretrack {
namespace {

using Json = nlohmann::ordered_json;

Json json_of(const CellSummary& c) {
  return {{"experiment", c.key.experiment},
          {"method", c.key.method},
          {"map", to_string(c.key.map)},
          {"target_speed_m_s", c.target_speed_m_s},
          {"events", c.events},
          {"successes", c.successes},
          {"success_low", c.success_95.low},
          {"success_high", c.success_95.high},
          {"failure_rate", c.failure_rate},
          {"occlusion_rate", c.occlusion_rate},
          {"fov_loss_rate", c.fov_loss_rate},
          {"near_rate", c.near_rate},
          {"min_distance_m", finite_json(c.min_distance_m)},
          {"band_share", c.band_share},
          {"collisions", c.collisions},
          {"min_clearance_m", finite_json(c.min_clearance_m)},
          {"plan_ms", json_of(c.plan_ms)},
          {"seed", c.seed},
          {"log_sha256", c.log_sha256}};
}

Json json_of(const Comparison& c) {
  return {{"experiment", c.key.experiment},
          {"map", to_string(c.key.map)},
          {"target_speed_m_s", c.key.target_speed_m_s},
          {"ours", kOurs},
          {"theirs", c.key.method},
          {"event_pairs", c.pairs},
          {"only_ours_succeeded", c.only_ours},
          {"only_theirs_succeeded", c.only_theirs},
          {"mcnemar_p", c.p},
          {"significant", c.significant()},
          {"failure_rate_ours", c.failure_ours},
          {"failure_rate_theirs", c.failure_theirs},
          {"failure_rate_difference", c.failure_difference.mean},
          {"difference_low", c.failure_difference.low},
          {"difference_high", c.failure_difference.high},
          {"difference_significant", c.failure_difference.excludes_zero()}};
}

template <class Item>
Json list_of(const std::vector<Item>& items, bool with_world) {
  Json list = Json::array();
  for (const Item& item : items) {
    Json json = json_of(item);
    if (with_world) json["world"] = item.world;
    list.push_back(std::move(json));
  }
  return list;
}

}  // namespace

std::string summary_json_of(const BenchResults& r) {
  const Json json = {{"cells", list_of(r.cells, false)},
                     {"scenes", list_of(r.scenes, true)},
                     {"comparisons", list_of(r.comparisons, false)},
                     {"scene_comparisons", list_of(r.scene_comparisons, true)}};
  return json.dump(2) + "\n";
}

}  // namespace foretrack
