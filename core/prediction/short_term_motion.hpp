// SPDX-License-Identifier: Apache-2.0
// What the last moments of a walk tell of the present and the next one. A filter lags behind a
// target that turns or brakes, and the chest turns ahead of the path: a small network, fitted on
// such walks, reads both.
#pragma once

#include <array>

#include "core/prediction/motion_history.hpp"

namespace foretrack {

/// As the target is seen: x along its heading, y to its left. Mirrored, the odd features change
/// sign and the even ones do not.
struct ShortTermFeatures {
  static constexpr std::array<double, 6> kAges_s = {0.06, 0.12, 0.2, 0.32, 0.48, 0.64};
  static constexpr int kEven = 4 + 3 * static_cast<int>(kAges_s.size());
  static constexpr int kOdd = 2 + 4 * static_cast<int>(kAges_s.size());
  std::array<double, kEven> even{};
  std::array<double, kOdd> odd{};
  double heading_rad = 0.0;  // of the velocity; of the chest of who stands
  bool body_known = false;
};

/// Features of a target whose states up to this one are in the history. chest_offset_rad: by which
/// the chest points aside of the course all the time.
ShortTermFeatures short_term_features(const MotionHistory& history, const TargetState& target,
                                      double chest_offset_rad = 0.0);

/// One layer of hidden units beside a linear map. What it says of a mirrored walk is mirrored.
struct ShortTermWeights {
  static constexpr int kHidden = 24;
  static constexpr int kOutputs = 4;  // error of position and velocity now; the same of soon
  template <int kColumns>
  using Rows = std::array<std::array<double, kColumns>, kOutputs>;
  std::array<std::array<double, ShortTermFeatures::kEven>, kHidden> hidden_even{};
  std::array<std::array<double, ShortTermFeatures::kOdd>, kHidden> hidden_odd{};
  Rows<kHidden> along_hidden{}, across_hidden{};
  Rows<ShortTermFeatures::kEven> along_even{};
  Rows<ShortTermFeatures::kOdd> across_odd{};
};

/// Written by bench/prediction's fit_motion, which also says there what it was fitted on.
const ShortTermWeights& short_term_weights(bool body_known);

/// kOutputs errors of constant velocity from the measured state: along and across the heading.
using ShortTermErrors = std::array<Vec2, ShortTermWeights::kOutputs>;
/// What the network says of the features. Cost: some 5000 flops.
ShortTermErrors short_term_errors(const ShortTermFeatures& features,
                                  const ShortTermWeights& weights);

/// How the target moves now and in a moment.
struct ShortTermMotion {
  static constexpr double kSoon_s = 0.2;
  PlanarState now;
  PlanarState soon;  // after kSoon_s, as far as it shows already
};

/// As the filter has it: at constant velocity.
ShortTermMotion filtered_motion(const TargetState& target);

/// As the network tells it. Cost: some 5000 flops.
ShortTermMotion short_term_motion(const MotionHistory& history, const TargetState& target,
                                  double chest_offset_rad = 0.0);

}  // namespace foretrack
