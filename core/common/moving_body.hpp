// SPDX-License-Identifier: Apache-2.0
// What moves where the vehicle flies: people and other vehicles. Search, corridor, optimiser, check
// and gate all keep clear of this one kind of thing.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "core/common/geometry.hpp"

namespace foretrack {

/// What it is, as far as that matters.
enum class BodyKind : std::uint8_t { kPerson, kVehicle, kUnknown };

/// An upright cylinder that moves over the ground. World ENU, SI.
struct MovingBody {
  static constexpr int kMaxPlaces = 16;

  std::uint32_t id = 0;  ///< stays with the body for as long as it is tracked; 0: has none yet
  BodyKind kind = BodyKind::kUnknown;
  bool followed = false;  ///< the person who is followed
  double stamp_s = 0.0;   ///< of position and velocity
  /// The middle of its lowest face: a person's place on the ground.
  Vec3 position_enu_m = Vec3::Zero();
  Vec3 velocity_enu_m_s = Vec3::Zero();
  Mat2 position_covariance_m2 = Mat2::Zero();     ///< horizontal
  Mat2 velocity_covariance_m2_s2 = Mat2::Zero();  ///< horizontal
  double radius_m = 0.25;
  double height_m = 1.75;
  double step_s = 0.2;  ///< between the places below
  int place_count = 0;  ///< of the places below; 0: it keeps its velocity
  /// Where it is expected step_s, 2 · step_s, … after the stamp; the first place_count are valid.
  std::array<Vec3, kMaxPlaces> places_enu_m{};

  /// Where it is expected at an absolute time. Between places: linear. Before the stamp: as at it.
  /// After the last place: on with the velocity of the last step.
  Vec3 expected_at(double time_s) const;
};

/// All bodies that are known at one moment, the nearest first where there are more than fit.
struct MovingBodies {
  static constexpr int kCapacity = 16;

  double stamp_s = 0.0;
  int count = 0;  ///< the first of `bodies` that are valid
  std::array<MovingBody, kCapacity> bodies{};

  /// Those that are valid.
  std::span<const MovingBody> all() const {
    return {bodies.data(), static_cast<std::size_t>(count)};
  }
  std::span<MovingBody> all() { return {bodies.data(), static_cast<std::size_t>(count)}; }
  /// False, and nothing is added, when there is no room.
  bool add(const MovingBody& body);
};

/// The person nearest to a place, over the ground; null: there are none.
const MovingBody* nearest_person(const MovingBodies& bodies, const Vec3& place_enu_m);

/// How any body may move, whatever it is expected to do.
struct BodyMotionBounds {
  double speed_m_s = 2.0;          ///< greatest; or as fast as it is seen to be, if that is more
  double acceleration_m_s2 = 3.0;  ///< greatest, in any direction
};

/// The gap in space between a ball (the vehicle's hull) and an upright cylinder: the distance of
/// their surfaces; negative when they overlap (by the depth at which they do). Exact outside.
double gap_m(const Vec3& ball_center_enu_m, double ball_radius_m, const Vec3& cylinder_foot_enu_m,
             double cylinder_radius_m, double cylinder_height_m);

/// The gap to where the body is expected at a time.
double expected_gap_m(const Vec3& ball_center_enu_m, double ball_radius_m, const MovingBody& body,
                      double time_s);

/// The least gap that is possible at a time, whatever the body does from its stamp on within the
/// bounds: it turns, stops or starts. A lower bound; never larger than expected_gap_m() as long as
/// the expected places obey the bounds themselves.
double least_gap_m(const Vec3& ball_center_enu_m, double ball_radius_m, const MovingBody& body,
                   double time_s, const BodyMotionBounds& bounds);

}  // namespace foretrack
