// SPDX-License-Identifier: Apache-2.0
#include "services/offline/experiments/experiment.hpp"

#include <fmt/format.h>

#include <stdexcept>

#include "core/simulator/encounter.hpp"
#include "core/simulator/hiding.hpp"

namespace foretrack {
namespace {

// One condition for each value of one key.
void sweep(std::vector<Condition>& conditions, std::string_view name, std::string_view key,
           std::initializer_list<std::string_view> values) {
  for (const auto value : values)
    conditions.push_back({fmt::format("{}={}", name, value), {fmt::format("{}={}", key, value)}});
}

// Each alone; what the others are then, the scenarios say (2 px, 0.05 s, 0.3 s, nothing else).
std::vector<Condition> stress_conditions() {
  std::vector<Condition> all = {{"nominal", {}}};
  sweep(all, "noise_px", "sensors.landmark_noise_px", {"4", "8"});
  sweep(all, "joint_noise_m", "sensors.joint_noise_m", {"0.06", "0.12"});
  sweep(all, "delay_s", "sensors.delay_s", {"0", "0.1", "0.2", "0.3"});
  sweep(all, "dropout", "sensors.dropout", {"0.3", "0.6"});
  sweep(all, "fov_gated", "sensors.fov_gated", {"false"});
  sweep(all, "gust_m_s", "wind.gust_m_s", {"1", "2"});
  sweep(all, "shoulder_lead_s", "target.shoulder_lead_s", {"0", "0.15", "0.45", "0.6"});
  return all;
}

// Where the chest points while somebody walks; what the scenarios say is the first.
std::vector<Condition> chest_conditions() {
  return {{"as_fitted", {}},
          {"backwards", {"target.shoulder_offset_rad=3.14159"}},
          {"flipped", {"sensors.flip_share=1"}},
          {"flips", {"sensors.flip_share=0.3"}},
          {"aside_69", {"target.shoulder_offset_rad=1.204"}},
          {"follows", {"target.shoulder_lead_s=-0.2"}},
          {"sways", {"target.shoulder_sway_rad=0.698", "target.shoulder_sway_hz=0.5"}},
          {"bias_23", {"target.shoulder_offset_rad=0.401"}}};
}

std::vector<Condition> encounter_conditions(bool all_round) {
  std::vector<Condition> all;
  for (const auto kind : kEncounterKindNames) {
    all.push_back({std::string(kind), {fmt::format("encounter={}", kind)}});
    if (all_round) all.back().settings.emplace_back("sensors.people_all_round=true");
  }
  return all;
}

std::vector<Condition> hiding_conditions() {
  std::vector<Condition> all;
  for (const auto kind : kHidingKindNames)
    all.push_back({std::string(kind), {fmt::format("hiding={}", kind)}});
  return all;
}

// One vehicle and several; and three of which one fails, or that hear each other badly.
std::vector<Condition> fleet_conditions() {
  const std::string three = "vehicles=[{}, {}, {}]";
  const auto befalls = [&](std::string_view kind) {
    return std::vector<std::string>{
        three, fmt::format("failures=[{{vehicle: uav1, at_s: 20, kind: {}}}]", kind)};
  };
  return {{"1", {"vehicles=[{}]"}},
          {"2", {"vehicles=[{}, {}]"}},
          {"3", {three}},
          {"5", {"vehicles=[{}, {}, {}, {}, {}]"}},
          {"3_radio", {three, "link={loss: 0.3, delay_s: 0.3}"}},
          {"3_apart",
           {three, "link={partitions: [{from_s: 15, to_s: 25, groups: [[uav1], [uav2, uav3]]}]}"}},
          {"3_dies", befalls("dies")},
          {"3_joins", befalls("joins")},
          {"3_blind", befalls("blind")}};
}

Experiment encounters(std::string name, std::string summary, bool all_round) {
  return {.name = std::move(name),
          .summary = std::move(summary),
          .event = EventKind::kEncounter,
          .worlds = {"encounter"},
          .speeds_m_s = {0.5, 1.0, 1.5, 2.0, 3.0},
          .conditions = encounter_conditions(all_round),
          .duration_s = 12.0,
          .runs = 20,
          .quick_runs = 2,
          .quick_duration_s = 10.0,
          .quick_speeds_m_s = {1.5, 3.0},
          .apart = true,
          .first_seed = kFirstEncounterSeed};
}

}  // namespace

const std::vector<Experiment>& experiments() {
  static const std::vector<Experiment> all = {
      {.name = "turning",
       .summary = "sharp turns between dense boxes and in narrow streets",
       .event = EventKind::kTurn,
       .worlds = {"dense_boxes", "street_blocks"},
       .speeds_m_s = {1.0, 1.5, 2.0},
       .runs = 10,
       .quick_duration_s = 30.0},
      {.name = "deceleration",
       .summary = "sudden stops from 2 m/s",
       .event = EventKind::kDeceleration,
       .worlds = {"deceleration"},
       .speeds_m_s = {2.0},
       .duration_s = 45.0,
       .runs = 40,
       .quick_runs = 3,
       .quick_duration_s = 45.0},
      {.name = "t_intersection",
       .summary = "a street ends at another; left or right by seed",
       .event = EventKind::kPass,
       .worlds = {"t_intersection"},
       .speeds_m_s = {1.5},
       .duration_s = 14.0,
       .runs = 200,
       .quick_runs = 6,
       .quick_duration_s = 14.0},
      {.name = "real_tracks",
       .summary = "recorded pedestrians in the open: predictions and intentions",
       .event = EventKind::kWalk,
       .worlds = {"recorded_walk"},
       .speeds_m_s = {},
       .runs = 0,
       .quick_runs = 10},
      {.name = "stress",
       .summary = "turning at 1.5 m/s with one thing made worse at a time",
       .event = EventKind::kTurn,
       .worlds = {"dense_boxes", "street_blocks", "doorways"},
       .speeds_m_s = {1.5},
       .conditions = stress_conditions(),
       .runs = 1,
       .quick_duration_s = 10.0},
      {.name = "chests",
       .summary = "sharp turns of people whose chest points elsewhere",
       .event = EventKind::kTurn,
       .worlds = {"dense_boxes"},
       .speeds_m_s = {2.0},
       .conditions = chest_conditions(),
       .runs = 10,
       .quick_runs = 2,
       .apart = true,
       .methods = {std::string(kOurs), "filter"}},
      {.name = "real_tracks_chest",
       .summary = "the same with a chest that leads by 0.3 s: it tells what was recorded",
       .event = EventKind::kWalk,
       .worlds = {"recorded_walk"},
       .speeds_m_s = {},
       .conditions = {{"", {"target.shoulder_lead_s=0.3"}}},
       .runs = 0,
       .quick_runs = 10,
       .apart = true},
      encounters("encounters",
                 "people come near: head-on, turning back, stopping, crossing, in groups", false),
      encounters("encounters_all_round", "the same, with bystanders detected on every side", true),
      {.name = "search",
       .summary = "the followed person walks to where the vehicle cannot follow, and comes back",
       .event = EventKind::kHiding,
       .worlds = {"hiding"},
       .speeds_m_s = {},
       .conditions = hiding_conditions(),
       .runs = 75,
       .quick_runs = 3,
       .apart = true,
       .first_seed = kFirstHidingSeed},
      {.name = "fleet",
       .summary = "one vehicle and several behind one person, where one vehicle fails",
       .event = EventKind::kTurn,
       .worlds = {"dense_boxes", "street_blocks", "hedges"},
       .speeds_m_s = {2.0, 3.0},
       .conditions = fleet_conditions(),
       .duration_s = 40.0,
       .runs = 6,
       .quick_duration_s = 30.0,
       .quick_speeds_m_s = {2.0},
       .apart = true,
       .methods = {std::string(kOurs)},
       .first_seed = kFirstFleetSeed}};
  return all;
}

const Experiment& experiment_named(std::string_view name) {
  std::string names;
  for (const Experiment& experiment : experiments()) {
    if (experiment.name == name) return experiment;
    names += (names.empty() ? "" : ", ") + experiment.name;
  }
  throw std::invalid_argument(fmt::format("no experiment '{}'; there are {} and all", name, names));
}

}  // namespace foretrack
