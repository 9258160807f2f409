// SPDX-License-Identifier: Apache-2.0
// Who is followed: as an operator says, else who it was, as far as that is certain; where it is
// not, the operator is asked.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include "core/choice/params.hpp"
#include "core/common/moving_body.hpp"
#include "core/common/person_look.hpp"

namespace foretrack {

/// How it stands with the person who is followed.
enum class ChoiceStatus : std::uint8_t {
  kWaiting,    ///< nobody was chosen yet, or nobody shall be followed
  kFollowing,  ///< and sure
  kDoubtful,   ///< it may be one of the candidates: the operator is asked
  kSearching,  ///< out of sight, looked for
  kLost,       ///< out of sight for too long
};

/// Somebody whom it may be.
struct ChoiceCandidate {
  std::uint32_t person_id = 0;
  double likeness = 0.0;            ///< of the clothes to those of who was chosen, 0 to 1
  Vec3 torso_enu_m = Vec3::Zero();  ///< the middle of it
  double difference = 0.0;          ///< the same as lasting_difference() has it
};

/// What is remembered of the person, and of whom they were mixed up with. A plain value that the
/// caller owns.
struct ChoiceState {
  static constexpr int kMostMet = 4;
  static constexpr int kMostWatched = MovingBodies::kCapacity;

  /// Somebody around while the person is lost.
  struct Watched {
    std::uint32_t id = 0;
    double since_s = 0.0;
  };

  double now_s = -1.0;
  bool nobody = false;   ///< an operator said so
  bool ordered = false;  ///< an operator ever said whom
  bool known = false;    ///< somebody was followed
  std::uint32_t followed_id = 0;
  std::optional<Appearance> wears;  ///< remembered of who was chosen
  std::optional<Appearance> seen;   ///< of who is followed, since they parted from others
  double seen_s = -1.0;             ///< image of the last look
  int met_count = 0;
  std::array<std::uint32_t, kMostMet> met{};  ///< who may be taken for them
  int doubtful_looks = 0;                     ///< while they were together
  int apart_count = 0;
  std::array<std::uint32_t, kMostWatched> apart{};  ///< others who were seen away from them
  double parted_s = -1e9;                           ///< from the last of them
  double asked_s = -1.0;                            ///< the operator, since then; < 0: not asked
  double lost_s = -1.0;                             ///< since then; < 0: not lost
  int watched_count = 0;
  std::array<Watched, kMostWatched> watched{};
};

/// World ENU. `bodies`: the followed person first, if they are seen.
struct ChoiceInput {
  double now_s = 0.0;
  const MovingBodies& bodies;
  std::span<const PersonLook> looks;  ///< of the bodies one by one, or empty
  Vec3 vehicle_enu_m = Vec3::Zero();
  bool doubtful = false;               ///< the last image leaves a doubt who is who
  std::optional<std::uint32_t> order;  ///< that came since the last call: whom to follow; 0: nobody
};

/// What is so, and what is to be done.
struct ChoiceResult {
  static constexpr int kMostCandidates = 4;

  ChoiceStatus status = ChoiceStatus::kWaiting;
  std::uint32_t person_id = 0;  ///< who is followed; 0: nobody
  double likeness = 1.0;        ///< of who is followed to who was chosen
  double waits_s = 0.0;         ///< for an answer, so long still
  int count = 0;                ///< of the candidates, likeliest first
  std::array<ChoiceCandidate, kMostCandidates> candidates{};
  /// Follow this one from now on; 0: nobody; none: nothing changes.
  std::optional<std::uint32_t> take_over;
  bool by_order = false;  ///< an operator said so; else it is who was chosen, found again

  std::span<const ChoiceCandidate> all() const {
    return {candidates.data(), static_cast<std::size_t>(count)};
  }
};

/// Call it with each frame.
///
/// While the person is followed and nobody is near, what they wear is learnt slowly. Whoever comes
/// near them, or into line with them as seen from the vehicle, may be taken for them: if images
/// leave a doubt meanwhile, or nobody saw them come, all are compared once they have parted. Who is
/// clearly more like the person is followed; who is as like is a candidate, and the operator is
/// asked. While the person is lost, everybody who is seen is compared with what is remembered of
/// them, however long ago. An answer is an order to follow one of them. Without one, the likeliest
/// is followed after wait_s, or the vehicle holds on, as the parameters say. Without images nobody
/// can be compared, and nothing is asked. Cost: some microseconds.
ChoiceResult choose(ChoiceState& state, const ChoiceInput& input, const ChoiceParams& params);

/// 1 for no difference, 0.5 for one of 0.24.
double likeness_of(double difference);

}  // namespace foretrack
