// SPDX-License-Identifier: Apache-2.0
// What an image shows of a person besides where they are.
#pragma once

#include <array>
#include <limits>
#include <optional>

#include "core/common/appearance.hpp"
#include "core/common/target.hpp"

namespace foretrack {

/// Height of the torso's centre above the feet, over that of the person (after the common
/// proportions of Drillis and Contini 1966).
inline constexpr double kTorsoShare = 0.674;

/// How somebody looks, as far as it tells people apart.
struct PersonLook {
  static constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

  double stamp_s = -1.0;  ///< of the image; < 0: seen in none
  Vec2 box_low_px = Vec2::Zero(), box_high_px = Vec2::Zero();
  bool has_landmarks = false;
  std::array<Landmark, kLandmarkCount> landmarks{};
  double body_yaw_rad = kNaN;  ///< world ENU, where the chest points; NaN: not known
  double head_yaw_rad = kNaN;  ///< where the nose points; NaN: not known

  double height_m = kNaN;           ///< as the image shows it; NaN: it does not
  std::optional<Appearance> wears;  ///< none: not seen; with the height: see wear()

  bool known() const { return stamp_s >= 0.0; }
  /// What the image shows of clothes, together with the height.
  void wear(const std::optional<Appearance>& clothes) {
    wears = clothes;
    if (wears) wears->height_m = height_m;
  }
};

}  // namespace foretrack
