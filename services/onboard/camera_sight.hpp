// SPDX-License-Identifier: Apache-2.0
// Whether a camera on the vehicle still sees.
#pragma once

#include "core/safety/watch_image.hpp"
#include "services/onboard/inputs.hpp"

namespace foretrack {

/// Looks at each image that comes, with how far the vehicle went and turned since the last one.
/// Without odometry nothing counts as frozen. What was seen last holds until another image comes.
class CameraSight {
 public:
  /// Both outlive this.
  CameraSight(Service& service, const VehicleInput& vehicle)
      : service_(service), vehicle_(vehicle) {}

  void look_at_color(std::span<const std::uint8_t> values);
  void look_at_depth(std::span<const float> depths_m);
  ImageFault fault() const { return fault_; }
  /// "the depth images are dark"; empty: it sees.
  std::string trouble(std::string_view which) const;

 private:
  double moved_m();

  Service& service_;
  const VehicleInput& vehicle_;
  ImageWatch watch_;
  ImageFault fault_ = ImageFault::kNone;
  std::optional<VehicleState> looked_from_;
};

}  // namespace foretrack
