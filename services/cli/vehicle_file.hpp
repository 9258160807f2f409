// SPDX-License-Identifier: Apache-2.0
// The file of a vehicle, as /etc/foretrack/uav1.yaml: each key is an option of the command without
// its dashes ("domain: 7", "peer: [10.0.7.3]", "use_sim_time: true").
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace foretrack {

/// Takes what the command line and the environment did not say from the file; an empty name does
/// nothing. Call it after parsing. Throws std::invalid_argument with every key that is no option,
/// and every value that the option refuses. A command that only looks at the bus leaves the keys of
/// others alone.
enum class OtherKeys { kRefused, kLeftAlone };
void take_vehicle_file(CLI::App& app, const std::string& file,
                       OtherKeys others = OtherKeys::kRefused);

}  // namespace foretrack
