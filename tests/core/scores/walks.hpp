// SPDX-License-Identifier: Apache-2.0
// Walks whose truth is known by construction.
#pragma once

#include "core/scores/truth.hpp"

namespace foretrack::testing {

inline constexpr double kStep_s = 0.02;

/// At 1.5 m/s along +x; velocity(t) may change that.
template <class VelocityAt>
Truth walk(double for_s, VelocityAt&& velocity_at) {
  Truth truth{.step_s = kStep_s, .samples = {}};
  Vec2 position = Vec2::Zero();
  for (int i = 0; i <= std::lround(for_s / kStep_s); ++i) {
    const Vec2 velocity = velocity_at(i * kStep_s);
    truth.samples.push_back({position, velocity});
    position += kStep_s * velocity;
  }
  return truth;
}

inline Truth straight_walk(double for_s) {
  return walk(for_s, [](double) { return Vec2(1.5, 0.0); });
}
/// By 90° to the left from at_s on, within 0.5 s.
inline Truth left_turn(double for_s, double at_s) {
  return walk(for_s, [=](double t) -> Vec2 {
    return 1.5 * direction_of(rad(180.0) * std::clamp(t - at_s, 0.0, 0.5));
  });
}
/// Brakes at 3 m/s² from at_s on.
inline Truth sudden_stop(double for_s, double at_s) {
  return walk(for_s, [=](double t) {
    return Vec2(std::max(0.0, 1.5 - 3.0 * std::max(0.0, t - at_s)), 0.0);
  });
}

/// Turns back on the line of the walk from at_s on, at 3 m/s².
inline Truth turn_back(double for_s, double at_s) {
  return walk(for_s,
              [=](double t) { return Vec2(1.5 - 3.0 * std::clamp(t - at_s, 0.0, 1.0), 0.0); });
}

}  // namespace foretrack::testing
