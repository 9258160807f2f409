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
  pass_on("--ros-distro", spec.ros_distro);
  return result;
}

void add_params(const FlightSpec& spec, ProcessSpec& process) {
  if (!spec.params_file.empty())
    process.arguments.insert(process.arguments.end(), {"--params", spec.params_file});
}

void remember_in(const FlightSpec& spec, ProcessSpec& gate) {
  gate.arguments.insert(gate.arguments.end(), {"--state-dir", spec.state_folder});
}

// Three times five processes are many for a small machine: the stages share one.
std::vector<ProcessSpec> vehicle_processes(const FleetNames& names, FlightSpec spec) {
  spec.vehicle = names.vehicle;
  std::vector<ProcessSpec> processes = {process("stages", spec), process("safety_gate", spec)};
  if (spec.map == "known") processes.front().arguments.push_back("--no-mapping");
  remember_in(spec, processes.back());
  for (auto& one : processes) {
    one.name = names.vehicle + '.' + one.name;
    one.arguments.insert(one.arguments.end(), {"--px4-namespace", names.px4_namespace});
    add_params(spec, one);
  }
  return processes;
}

}  // namespace

bool is_onboard(const std::string& process) {
  const std::string service = process.substr(process.find('.') + 1);
  return service == "stages" || std::find(std::begin(kOnboardServices), std::end(kOnboardServices),
                                          service) != std::end(kOnboardServices);
}

std::vector<ProcessSpec> onboard_processes(const FlightSpec& spec) {
  std::error_code none_there;
  std::filesystem::remove_all(spec.state_folder, none_there);  // its clock begins anew
  std::vector<ProcessSpec> processes;
  for (const FleetNames& names : spec.vehicles)
    for (auto& process : vehicle_processes(names, spec)) processes.push_back(std::move(process));
  if (!processes.empty()) return processes;
  for (const std::string name : kOnboardServices) {
    if (name == "mapping" && spec.map == "known") continue;
    processes.push_back(process(name, spec));
    add_params(spec, processes.back());
  }
  remember_in(spec, processes.back());
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
  if (!spec.vehicles.empty()) add("--vehicles", std::to_string(spec.vehicles.size()));
  if (spec.seed) add("--seed", std::to_string(*spec.seed));
  if (!spec.track_file.empty()) add("--track", spec.track_file);
  for (const auto& setting : spec.settings) add("--set", setting);
  if (spec.pedestrian >= 0) add("--pedestrian", std::to_string(spec.pedestrian));
  return result;
}

}  // namespace foretrack
