// SPDX-License-Identifier: Apache-2.0
// All services of the vehicle in one process, a thread each.
#pragma once

#include <span>

#include "core/tracker/tracker.hpp"
#include "services/common/options.hpp"
#include "services/common/stop.hpp"

namespace foretrack {

/// A service of the vehicle. Its name is that of its stage, subcommand, process and health.
struct OnboardService {
  const char* name;
  const char* summary;
  const char* params;  // its section in the parameter file
  void (*run)(const ServiceOptions&, const TrackerParams&, Stop&);
};

/// In the order of the pipeline.
std::span<const OnboardService> onboard_services();

/// Until the stop is requested. If one service fails to start, all stop and its error is thrown.
/// Without mapping, a known map must come from elsewhere.
void run_onboard(const ServiceOptions& options, const TrackerParams& params, bool with_mapping,
                 Stop& stop);

}  // namespace foretrack
