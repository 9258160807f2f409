// SPDX-License-Identifier: Apache-2.0
// foretrack black_box: what `onboard` records of every flight, as a process of its own.
#include <memory>

#include "services/cli/commands.hpp"
#include "services/cli/vehicle_file.hpp"
#include "services/common/options.hpp"
#include "services/files/config/load_params.hpp"
#include "services/ground_station/recording/black_box.hpp"

namespace foretrack {

std::function<int()> prepare_black_box(CLI::App& app) {
  const auto options = std::make_shared<ServiceOptions>();
  add_options(app, *options);
  return [&app, options] {
    take_vehicle_file(app, options->config_file);
    TrackerParams params =
        options->params_file.empty() ? TrackerParams{} : load_params(options->params_file);
    if (options->record.off) return 0;
    Stop stop;
    const SignalStop signals(stop);
    set_up_logging(options->log_level);
    station::run_black_box(*options, yaml_of_params(params), stop);
    return 0;
  };
}

}  // namespace foretrack
