// SPDX-License-Identifier: Apache-2.0
// Somebody who is tracked becomes the person who is followed, or the other way round.
#pragma once

#include <optional>

#include "core/bodies/track_bodies.hpp"

namespace foretrack {

/// Who keeps which number.
enum class Numbers : std::uint8_t {
  kStay,  // another person is followed now: everybody keeps theirs
  kSwap,  // the one who was chosen was found again: they have their number back
};

/// The believed body of that number is followed from now on; who was followed, if `before` is
/// usable, becomes one of the others. Returns the state to go on from, with the torso of a person
/// `height_m` tall; none, and nothing changes, if nobody has that number.
std::optional<TargetState> follow_body(BodiesState& state, std::uint32_t id,
                                       const TargetState& before, Numbers numbers, double height_m,
                                       const BodyParams& params);

/// Nobody is followed from now on; who was, if usable, becomes one of the others.
void follow_no_body(BodiesState& state, const TargetState& before, double height_m,
                    const BodyParams& params);

}  // namespace foretrack
