// Rendered images into observations, through the real pose network: what the perception service
// does, in lock-step.
#pragma once

#include <deque>
#include <optional>

#include "core/perception/perceive_image.hpp"
#include "core/simulator/color_camera.hpp"

namespace foretrack {

class CameraEye {
 public:
  /// delay_s: from an image to what is seen in it.
  CameraEye(PoseNetwork network, const PerceptionParams& params, double delay_s)
      : network_(std::move(network)), params_(params), delay_s_(delay_s) {}

  /// Looks at the image, if there is one. Returns what was seen delay_s ago, if somebody was; valid
  /// until the next call.
  const TargetObservation* look(const ColorImage* image, double now_s);
  /// Of the last image.
  const PoseResult& result() const { return result_; }

 private:
  PoseNetwork network_;
  PerceptionParams params_;
  double delay_s_;
  PoseState state_;
  PoseResult result_;
  std::deque<TargetObservation> waiting_;
  TargetObservation delivered_;
};

}  // namespace foretrack
