// SPDX-License-Identifier: Apache-2.0
// The services of the vehicle. The gate has a process of its own; the stages before it may share
// one, a thread each.
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

/// Which of the stages there are.
struct StageChoice {
  bool mapping = true;  ///< without, a known map must come from elsewhere
  bool fleet = true;    ///< without, the vehicle flies as if it were alone
};

/// All but the gate, in this process, until the stop is requested. If one service fails to start,
/// all stop and its error is thrown.
void run_stages(const ServiceOptions& options, const TrackerParams& params, const StageChoice& with,
                Stop& stop);

}  // namespace foretrack
