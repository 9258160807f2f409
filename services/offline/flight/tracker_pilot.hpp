// SPDX-License-Identifier: Apache-2.0
// The tracker as the pilot of a lock-step flight.
#pragma once

#include "core/tracker/tracker.hpp"
#include "services/offline/flight/camera_eye.hpp"
#include "services/offline/flight/fly_pilot.hpp"
#include "services/offline/flight/steady_operator.hpp"

namespace foretrack {

/// What the gate wants, as the simulated autopilot takes it.
AutopilotInput input_of(const GateResult& gate);

/// One vehicle's tracker, with the scenario's operator.
class TrackerPilot {
 public:
  /// With colour images, the pose network sees for the tracker; throws std::runtime_error that says
  /// what of it is missing, and how to get it.
  TrackerPilot(const Scenario& scenario, const TrackerParams& params);

  /// One step: decides, commands, and writes its part of the row. The output is valid until the
  /// next step. fleet: null, it flies alone. order: comes before the operator's; null: none.
  TrackerOutput fly(PilotStep step, const FleetLink* fleet = nullptr,
                    const MissionCommand* order = nullptr);

 private:
  const TrackerParams& params_;
  TrackerState tracker_;
  std::optional<CameraEye> eye_;
  FlightRow last_;  // what was last predicted and planned stays in the rows until the next plan
  SteadyOperator operator_;
};

}  // namespace foretrack
