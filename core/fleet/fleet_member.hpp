// SPDX-License-Identifier: Apache-2.0
// What a vehicle tells the others of its fleet.
#pragma once

#include "core/common/prediction.hpp"
#include "core/common/short_text.hpp"
#include "core/common/target.hpp"
#include "core/common/trajectory.hpp"

namespace foretrack {

inline constexpr int kFleetCapacity = 16;  // vehicles, this one among them
inline constexpr int kSeatSectors = 12;    // of 30°, the first one towards east
/// The band round the person is one vehicle's place; the others stand behind it.
enum class SeatRing : std::uint8_t { kNear, kFar };
inline constexpr int kSeatCount = 2 * kSeatSectors;

/// A direction and a ring from where a person may be seen: a number below kSeatCount, or none.
struct Seat {
  std::int8_t number = -1;

  bool is_none() const { return number < 0; }
  int sector() const { return number % kSeatSectors; }
  SeatRing ring() const { return static_cast<SeatRing>(number / kSeatSectors); }
  double bearing_rad() const { return sector() * 2.0 * kPi / kSeatSectors; }
  static Seat of(int sector, SeatRing ring) {
    return {static_cast<std::int8_t>(sector + kSeatSectors * static_cast<int>(ring))};
  }
  bool operator==(const Seat&) const = default;
};

/// What a vehicle would see from a seat, by its own map.
struct SeatBid {
  static constexpr float kCannot_s = 25.5F;  ///< it is not free, or too far

  float way_s = kCannot_s;                   ///< time to get there
  std::array<float, kMaxIntentions> sees{};  ///< share of the next time, for each intention
  bool possible() const { return way_s < kCannot_s; }
};

/// The bid as a message carries it: in tenths of a second, and shares in 255ths. Who tells it
/// counts with it as well, so that all divide alike.
SeatBid as_told(const SeatBid& bid);

/// Somebody who can be followed, as one vehicle knows them.
struct FleetPerson {
  std::uint32_t id = 0;  ///< the vehicle's own number
  TrackStatus status = TrackStatus::kNone;
  bool in_sight = false;
  Vec3 position_enu_m = Vec3::Zero();  ///< the torso's centre
  Vec3 velocity_enu_m_s = Vec3::Zero();
  Mat6 covariance = Mat6::Identity();  ///< of (position, velocity)
};

/// What is flown; then the vehicle stands.
struct FleetPlan {
  static constexpr int kMaxPieces = 16;

  double start_s = 0.0;
  int count = 0;
  std::array<QuinticPiece, kMaxPieces> pieces{};

  bool empty() const { return count == 0; }
  Vec3 position(double time_s) const;  ///< absolute time; precondition: not empty
};

/// One message. World ENU of its `frame`. A plain value of fixed size.
struct FleetMember {
  static constexpr int kMaxPersons = 4;

  ShortText vehicle, frame;
  double stamp_s = 0.0;
  std::uint32_t sequence_number = 0;  ///< grows by one from message to message
  bool flies = false;                 ///< follows, or is ready to
  Vec3 position_enu_m = Vec3::Zero();
  Vec3 velocity_enu_m_s = Vec3::Zero();
  double yaw_rad = 0.0;
  double radius_m = 0.25;
  double battery = -1.0;  ///< of a full one; negative: not known
  FleetPlan plan;
  std::uint32_t follows = 0;  ///< id of one of the persons; 0: nobody
  int person_count = 0;
  std::array<FleetPerson, kMaxPersons> persons{};
  int intention_count = 0;
  std::array<double, kMaxIntentions> intentions{};  ///< probabilities, of the one it follows
  Seat seat;                                        ///< that it holds
  bool is_near = false;                             ///< it is the one in the band
  std::array<SeatBid, kSeatCount> bids{};

  std::span<const FleetPerson> all_persons() const {
    return {persons.data(), static_cast<std::size_t>(person_count)};
  }
  /// Null: it follows nobody.
  const FleetPerson* followed() const;
  /// The one it follows, at the stamp.
  bool sees_followed() const;
};

}  // namespace foretrack
