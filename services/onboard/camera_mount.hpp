// SPDX-License-Identifier: Apache-2.0
// Where a camera sat in the body when an image was taken.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "services/onboard/transform_input.hpp"

namespace foretrack {

/// As the configuration says; else as transforms lead from the image's own frame to the body's:
/// <vehicle>/<frame> before <frame>, so that those of another vehicle are not taken.
class CameraMount {
 public:
  /// `configured`: x, y, z, roll, pitch, yaw of ServiceOptions, or empty. `transforms` outlives
  /// this.
  CameraMount(Service& service, const std::vector<double>& configured, TransformInput& transforms);

  /// Without transforms that lead there the camera is taken to look ahead from the body's origin,
  /// and trouble() says so. None: they lead there, but a joint on the way is not known at that
  /// time.
  std::optional<Pose> at(const std::string& frame_id, double stamp_s);
  /// Why the last answer was a guess, or none; empty: it was not.
  const std::string& trouble() const { return trouble_; }

 private:
  TransformTree::Found find(const std::string& frame_id, double stamp_s) const;

  const Names names_;
  std::optional<Pose> configured_;
  TransformInput& transforms_;
  std::string trouble_;
};

}  // namespace foretrack
