// SPDX-License-Identifier: Apache-2.0
// foretrack params, foretrack scenarios: what can be set.
#include <fmt/format.h>

#include <memory>

#include "services/cli/commands.hpp"
#include "services/files/config/load_params.hpp"
#include "services/files/config/load_scenario.hpp"

namespace foretrack {

std::function<int()> prepare_params(CLI::App& app) {
  struct Options {
    std::string stage, file;
    bool yaml = false, markdown = false;
  };
  const auto o = std::make_shared<Options>();
  app.add_option(
      "stage", o->stage,
      "perception, mapping, bodies, choice, prediction, planning or safety; all if left out");
  app.add_option("--params", o->file, "with the values of this file")->check(CLI::ExistingFile);
  auto* yaml = app.add_flag("--yaml", o->yaml, "as a parameter file");
  app.add_flag("--markdown", o->markdown, "as a page")->excludes(yaml);
  return [o] {
    TrackerParams params = o->file.empty() ? TrackerParams{} : load_params(o->file);
    fmt::print("{}", o->yaml       ? yaml_of_params(params, o->stage)
                     : o->markdown ? markdown_of_params(params, o->stage)
                                   : describe_params(params, o->stage));
    return 0;
  };
}

std::function<int()> prepare_scenarios(CLI::App&) {
  return [] {
    for (const auto& name : scenario_names()) fmt::print("{}\n", name);
    return 0;
  };
}

}  // namespace foretrack
