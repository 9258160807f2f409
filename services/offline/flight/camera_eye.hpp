// SPDX-License-Identifier: Apache-2.0
// Rendered images into observations, through the real pose network: what the perception service
// does, in lock-step.
#pragma once

#include <deque>
#include <limits>
#include <optional>

#include "core/perception/perceive.hpp"
#include "core/perception/perceive_image.hpp"
#include "core/perception/sight_people.hpp"
#include "core/simulator/simulate.hpp"
#include "core/tracker/follow_people.hpp"

namespace foretrack {

class CameraEye {
 public:
  /// delay_s: from an image to what is seen in it.
  CameraEye(PoseNetwork network, const PerceptionParams& params, const ChoiceParams& choice,
            double delay_s)
      : network_(std::move(network)), params_(params), delay_s_(delay_s) {
    begin_with(state_, choice);
  }

  struct Seen {
    bool found = false;  // the person; there is an observation
    PeopleSeen others;
    TargetObservation observation;
    double torso_depth_m = std::numeric_limits<double>::quiet_NaN();  // NaN: not measured
    std::optional<Appearance> wears;                                  // the person
  };

  /// Looks at the image, if there is one, near where the track expects the person; `depth`, if
  /// there is one, is of the same instant. Returns what was seen delay_s ago; null if there was no
  /// image then. Valid until the next call.
  const Seen* look(const SimulatorOutput& output, const PerceptionState& track,
                   const VehicleHistory& vehicles);
  /// Follows somebody else from now on, who wears that; or nobody.
  void follow(const std::optional<Appearance>& wears) { follow_other(state_, wears); }
  void follow_nobody() { state_.follows = false; }
  /// Of the last image.
  const PoseResult& result() const { return result_; }

 private:
  PoseNetwork network_;
  PerceptionParams params_;
  double delay_s_;
  PoseState state_;
  PoseResult result_;
  std::deque<Seen> waiting_;
  Seen delivered_;
};

}  // namespace foretrack
