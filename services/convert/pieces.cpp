// SPDX-License-Identifier: Apache-2.0
#include "services/convert/pieces.hpp"

#include "services/convert/geometry.hpp"

namespace foretrack {
namespace {

constexpr double kJoin_m = 0.01;
constexpr double kJoin_m_s = 0.05;

}  // namespace

void check_ends(Checks& checks, const QuinticPiece& piece) {
  for (const double t : {0.0, piece.duration_s}) {
    checks.within("pieces.position", to_array(piece.position(t)), limits::kPosition_m);
    checks.within("pieces.velocity", to_array(piece.velocity(t)), limits::kSpeed_m_s);
    checks.within("pieces.acceleration", to_array(piece.acceleration(t)),
                  limits::kAcceleration_m_s2);
  }
}

void check_join(Checks& checks, const QuinticPiece& a, const QuinticPiece& b) {
  const double jump_m = (a.position(a.duration_s) - b.position(0.0)).norm();
  const double jump_m_s = (a.velocity(a.duration_s) - b.velocity(0.0)).norm();
  checks.in_range("pieces.position jump", jump_m, 0.0, kJoin_m);
  checks.in_range("pieces.velocity jump", jump_m_s, 0.0, kJoin_m_s);
}

}  // namespace foretrack
