// SPDX-License-Identifier: Apache-2.0
// What the calibrated probabilities are a function of.
#pragma once

#include <array>

#include "core/prediction/assess_intention.hpp"

namespace foretrack {

/// The same features describe both turns, mirrored. Without a map, or without a body yaw, those
/// that need it are 0 and other weights are used (see calibrate.hpp).
struct IntentionFeatures {
  static constexpr int kTurnCount = 56;
  static constexpr int kDecelerateCount = 18;
  std::array<double, kTurnCount> left{};
  std::array<double, kTurnCount> right{};
  std::array<double, kDecelerateCount> decelerate{};
  bool map_known = false;
  bool body_known = false;
};

/// Needs the scores of the assessment. Cost: some dozens of flops.
IntentionFeatures intention_features(const MotionCues& motion, const Surroundings& surroundings,
                                     const IntentionAssessment& assessment, bool map_known);

}  // namespace foretrack
