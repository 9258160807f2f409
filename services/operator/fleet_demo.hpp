// SPDX-License-Identifier: Apache-2.0
// A whole flight of several vehicles in simulation: starts it, watches it, measures it.
#pragma once

#include "services/operator/demo_flight.hpp"

namespace foretrack {

/// As fly_demo(), for a scenario with vehicles. Writes metrics.json, a folder of each vehicle's
/// flight, and logs/. The exit status: 0 if all vehicles flew without a contact or collision.
int fly_fleet_demo(const DemoOptions& options);

}  // namespace foretrack
