// SPDX-License-Identifier: Apache-2.0
// What pieces of a trajectory must satisfy, whoever tells them.
#pragma once

#include "core/common/trajectory.hpp"
#include "services/convert/checks.hpp"

namespace foretrack {

/// Positions, speeds and accelerations at both ends, so that no coefficient can hide behind 0 · t.
void check_ends(Checks& checks, const QuinticPiece& piece);
/// Whether the second begins where the first ends, as fast.
void check_join(Checks& checks, const QuinticPiece& first, const QuinticPiece& second);

}  // namespace foretrack
