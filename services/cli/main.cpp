// SPDX-License-Identifier: Apache-2.0
// foretrack: one program, a subcommand a service or tool.
#include <cstdio>
#include <exception>

#include "core/version.hpp"
#include "services/cli/commands.hpp"

namespace {

constexpr int kFailed = 1;
constexpr int kMisused = 2;

int run(int argc, char** argv) {
  CLI::App app("foretrack: follows a person by reading their intention");
  app.set_version_flag("--version", foretrack::kVersion);
  app.require_subcommand(1);
  std::function<int()> chosen;
  auto commands = foretrack::flight_commands();
#ifdef FORETRACK_DDS
  for (const auto& command : foretrack::service_commands()) commands.push_back(command);
  for (const auto& command : foretrack::operator_commands()) commands.push_back(command);
#endif
  for (const auto& command : commands) {
    CLI::App* sub = app.add_subcommand(command.name, command.summary);
    const std::function<int()> action = command.prepare(*sub);
    sub->callback([&chosen, action] { chosen = action; });
  }
  CLI11_PARSE(app, argc, argv);
  return chosen();
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const std::invalid_argument& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return kMisused;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return kFailed;
  }
}
