// SPDX-License-Identifier: Apache-2.0
#include "services/cli/commands.hpp"

namespace foretrack {

std::vector<Command> flight_commands() {
  return {
      {"fly", "fly a scenario in lock-step, without DDS, and measure it", prepare_fly},
      {"bench", "fly the experiments over many seeds, compare methods, write a report",
       prepare_bench},
      {"perceive", "people in pictures, videos and cameras: landmarks, position, yaw",
       prepare_perceive},
      {"params", "the parameters of the stages, with units, ranges and meanings", prepare_params},
      {"scenarios", "the scenarios that ship with the program", prepare_scenarios},
      {"map", "the extents and cells of an OctoMap file", prepare_map}};
}

}  // namespace foretrack
