// SPDX-License-Identifier: Apache-2.0
#include "services/launch/flight_processes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <iterator>

namespace foretrack {
namespace {

ProcessSpec process(const std::string& name, const FlightSpec& spec) {
  ProcessSpec result{
      name,
      {name, "--vehicle", spec.vehicle, "--domain", std::to_string(spec.domain), "--use-sim-time"}};
  const auto pass_on = [&result](const char* option, const std::string& value) {
    if (!value.empty()) result.arguments.insert(result.arguments.end(), {option, value});
  };
  pass_on("--interface", spec.interface);
  pass_on("--security", spec.security);
  return result;
}

}  // namespace

bool is_onboard(const std::string& service) {
  return std::find(std::begin(kOnboardServices), std::end(kOnboardServices), service) !=
         std::end(kOnboardServices);
}

std::vector<ProcessSpec> onboard_processes(const FlightSpec& spec) {
  std::vector<ProcessSpec> processes;
  for (const std::string name : kOnboardServices) {
    if (name == "mapping" && spec.map == "known") continue;
    processes.push_back(process(name, spec));
    if (!spec.params_file.empty())
      for (const auto& word : {std::string("--params"), spec.params_file})
        processes.back().arguments.push_back(word);
  }
  std::error_code none_there;
  std::filesystem::remove_all(spec.state_folder, none_there);  // its clock begins anew
  auto& gate = processes.back().arguments;
  gate.insert(gate.end(), {"--state-dir", spec.state_folder});
  return processes;
}

ProcessSpec simulator_process(const FlightSpec& spec) {
  ProcessSpec result = process("simulator", spec);
  result.restart = false;  // its time would begin anew
  auto& words = result.arguments;
  const auto add = [&](const char* option, const std::string& value) {
    words.insert(words.end(), {option, value});
  };
  add("--scenario", spec.scenario);
  add("--map", spec.map);
  if (spec.camera) words.push_back("--camera");
  add("--people-wait", "60");
  add("--speed", fmt::format("{}", spec.speed));
  if (spec.duration_s > 0.0)
    add("--for", fmt::format("{}", spec.duration_s));
  else
    words.push_back("--endless");
  if (spec.seed) add("--seed", std::to_string(*spec.seed));
  if (!spec.track_file.empty()) add("--track", spec.track_file);
  for (const auto& setting : spec.settings) add("--set", setting);
  if (spec.pedestrian >= 0) add("--pedestrian", std::to_string(spec.pedestrian));
  return result;
}

}  // namespace foretrack
