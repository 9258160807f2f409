// SPDX-License-Identifier: Apache-2.0
// foretrack: one program, a subcommand a service or tool.
#include <fmt/format.h>

#include <cstdio>
#include <exception>
#include <limits>
#include <numeric>
#include <string_view>

#include "core/version.hpp"
#include "services/cli/commands.hpp"

namespace {

constexpr int kFailed = 1;
constexpr int kMisused = 2;

// How many letters must be put in, left out or changed.
std::size_t distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = row[0]++;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t changed = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({changed, row[j] + 1, diagonal + 1});
    }
  }
  return row.back();
}

// Throws if it is none, and names the nearest.
void check_command(std::string_view word, const std::vector<foretrack::Command>& commands) {
  const char* nearest = "";
  auto least = std::numeric_limits<std::size_t>::max();
  for (const auto& command : commands) {
    const auto letters = distance(word, command.name);
    if (letters == 0) return;
    if (letters >= least) continue;
    least = letters;
    nearest = command.name;
  }
  throw std::invalid_argument(
      fmt::format("there is no command '{}'; the nearest is '{}', `foretrack --help` lists all",
                  word, nearest));
}

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
  if (argc > 1 && *argv[1] != '-') check_command(argv[1], commands);
  for (const auto& command : commands) {
    CLI::App* sub = app.add_subcommand(command.name, command.summary);
    const std::function<int()> action = command.prepare(*sub);
    sub->callback([&chosen, action] { chosen = action; });
  }
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : kMisused;
  }
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
