// SPDX-License-Identifier: Apache-2.0
// Frames in, people with their places out.
#pragma once

#include "services/offline/images/calibration.hpp"
#include "services/offline/images/frame_source.hpp"
#include "services/offline/images/people_json.hpp"

namespace foretrack {

class PersonFinder {
 public:
  /// Without a calibration, people have no place in the camera's frame.
  PersonFinder(PoseNetwork network, const PerceptionParams& params,
               std::optional<CameraWithLens> calibration);

  /// Everybody in a picture that stands alone.
  SeenFrame look(const Frame& picture);
  /// The chosen person of a video: whoever was seen most clearly first.
  SeenFrame follow(const Frame& frame);

  bool ambiguous() const { return ambiguous_; }  // the last choice

 private:
  SeenPerson seen(const PersonPose& pose) const;
  /// Throws std::runtime_error if the calibration is that of another size.
  void check_size(const Frame& frame) const;

  PoseNetwork network_;
  PerceptionParams params_;
  std::optional<CameraWithLens> calibration_;
  PoseState state_;
  bool ambiguous_ = false;
};

}  // namespace foretrack
