// SPDX-License-Identifier: Apache-2.0
// What a scenario file says of a fleet: vehicles, link, failures.
#pragma once

#include "core/simulator/scenario.hpp"
#include "services/files/yaml/yaml_reader.hpp"

namespace foretrack {

/// Faults go to the reader's: names that are twice there, or that nobody has.
void read_fleet(YamlReader& r, Scenario& scenario);

/// So many vehicles: the first of the scenario's, and others after them. Failures of those that are
/// left out do not happen. Throws std::invalid_argument if there are too many.
void set_vehicles(int count, Scenario& scenario);

}  // namespace foretrack
