// SPDX-License-Identifier: Apache-2.0
// The subcommands of the program. A command adds its options to its CLI::App and returns what to
// run once they are parsed; the returned number is the program's exit status.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <vector>

namespace foretrack {

struct Command {
  const char* name;
  const char* summary;
  std::function<int()> (*prepare)(CLI::App& app);
};

/// Those that need no DDS: fly, bench, perceive, params, scenarios, map.
std::vector<Command> flight_commands();

/// The services of the vehicle, what checks its file, and the simulator. Only in a build with DDS.
std::vector<Command> service_commands();

/// What an operator uses: up, demo, order, monitor, topics, doctor, station, record, replay,
/// report, clip, discovery-server, security. Only in a build with DDS.
std::vector<Command> operator_commands();

std::function<int()> prepare_fly(CLI::App& app);
std::function<int()> prepare_bench(CLI::App& app);
std::function<int()> prepare_perceive(CLI::App& app);
std::function<int()> prepare_params(CLI::App& app);
std::function<int()> prepare_scenarios(CLI::App& app);
std::function<int()> prepare_map(CLI::App& app);
std::function<int()> prepare_up(CLI::App& app);
std::function<int()> prepare_demo(CLI::App& app);
std::function<int()> prepare_order(CLI::App& app);
std::function<int()> prepare_monitor(CLI::App& app);
std::function<int()> prepare_topics(CLI::App& app);
std::function<int()> prepare_doctor(CLI::App& app);
std::function<int()> prepare_station(CLI::App& app);
std::function<int()> prepare_record(CLI::App& app);
std::function<int()> prepare_replay(CLI::App& app);
std::function<int()> prepare_report(CLI::App& app);
std::function<int()> prepare_clip(CLI::App& app);
std::function<int()> prepare_check(CLI::App& app);
std::function<int()> prepare_black_box(CLI::App& app);
std::function<int()> prepare_discovery_server(CLI::App& app);
std::function<int()> prepare_security(CLI::App& app);

}  // namespace foretrack
