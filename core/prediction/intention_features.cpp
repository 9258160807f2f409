// SPDX-License-Identifier: Apache-2.0
#include "core/prediction/intention_features.hpp"

#include <algorithm>

namespace foretrack {
namespace {

template <std::size_t N>
class Writer {
 public:
  explicit Writer(std::array<double, N>& out) : out_(out) {}
  void add(double value) { out_.at(next_++) = value; }

 private:
  std::array<double, N>& out_;
  std::size_t next_ = 0;
};

double positive(double x) {
  return std::max(x, 0.0);
}

double square(double x) {
  return x * x;
}

// One side of a target that may turn to it.
struct Side {
  double sign;  // +1 left, −1 right
  const IntentionBelief& belief;
  double half_angle_rad, half_angle_ahead_rad;
  const std::array<double, Surroundings::kSideCount>& width_m;
};
using TurnWriter = Writer<IntentionFeatures::kTurnCount>;

// Time until an obstacle ahead is reached, with the target's own size taken off.
double time_to_obstacle_s(const MotionCues& motion, const Surroundings& s) {
  constexpr double kBody_m = 0.3;
  return positive(s.obstacle_distance_m - kBody_m) / std::max(motion.speed_m_s, 0.3);
}

double last_width_m(const std::array<double, Surroundings::kSideCount>& width_m) {
  double last = width_m[0];
  for (const double w : width_m)
    if (w > 0.0) last = w;
  return last;
}

void add_motion(TurnWriter& out, const Side& side, const MotionCues& motion) {
  out.add(1.0);
  out.add(side.sign * std::clamp(motion.turn_rate_rad_s, -3.0, 3.0));
  out.add(positive(side.sign * motion.recent_turn_rad));
  out.add(positive(-side.sign * motion.recent_turn_rad));
  out.add(motion.speed_m_s);
  out.add(std::clamp(motion.speed_fall_m_s, -1.0, 1.0));
  const double body = side.sign * std::clamp(motion.steady_body_turn_rad, -1.2, 1.2);
  out.add(body);
  out.add(positive(body) * positive(body));
  out.add(std::min(side.belief.observation, 3.0));
  for (const double swing_rad : motion.body_swing_rad)
    out.add(side.sign * std::clamp(swing_rad, -1.2, 1.2));
  const double begun = positive(side.sign * motion.body_swing_rad[MotionCues::kTellingSwing]);
  out.add(std::min(begun * begun, 1.5));
  // How far the chest has left the course, and how much of a turn shows already.
  const double left_rad = side.sign * std::clamp(motion.body_turn_rad, -1.2, 1.2);
  out.add(left_rad);
  out.add(side.sign * std::clamp(motion.soon_turn_rad, -1.2, 1.2));
  out.add(motion.manoeuvre);
  out.add(std::clamp(motion.recent_fall_m_s[0], -1.0, 1.0));
  out.add(motion.log_turns_per_s);
  out.add(std::exp(-motion.straight_s / 3.0));
}

// soon: nearness of an obstacle ahead.
void add_side(TurnWriter& out, const Side& side, double soon) {
  out.add(side.belief.potential);
  out.add(side.half_angle_rad);
  out.add(side.half_angle_ahead_rad);
  out.add(soon * last_width_m(side.width_m) / Surroundings::kSideRange_m);
  const double hugging = std::exp(-side.width_m[0] / 0.7);
  out.add(hugging);
  // Where along the way the side opens, and whether the target keeps to that side.
  double widest_m = side.width_m[0];
  for (int i = 1; i < Surroundings::kSideCount; ++i) {
    const double opening = std::min(1.0, positive(side.width_m[i] - widest_m));
    widest_m = std::max(widest_m, side.width_m[i]);
    out.add(opening);
    out.add(opening * hugging);
  }
}

void write_turn(const Side& side, const Side& other, const MotionCues& motion,
                const Surroundings& surroundings, bool map_known,
                std::array<double, IntentionFeatures::kTurnCount>& features) {
  Writer out(features);
  add_motion(out, side, motion);
  if (!map_known) return;
  const double obstacle_s = time_to_obstacle_s(motion, surroundings);
  const double soon = std::exp(-obstacle_s / 1.5);
  out.add(soon);
  out.add(std::exp(-obstacle_s / 0.5));
  out.add(soon * positive(last_width_m(side.width_m) - last_width_m(other.width_m)) /
          Surroundings::kSideRange_m);
  add_side(out, side, soon);
  add_side(out, other, soon);
}

void write_decelerate(const MotionCues& motion, const Surroundings& surroundings,
                      const IntentionAssessment& assessment, bool map_known,
                      std::array<double, IntentionFeatures::kDecelerateCount>& features) {
  Writer out(features);
  out.add(1.0);
  out.add(motion.speed_m_s);
  out.add(std::clamp(motion.speed_fall_m_s, -1.0, 1.0));
  out.add(std::clamp(assessment[Intention::kDecelerate].observation, 0.0, 3.0));
  out.add(std::abs(std::clamp(motion.turn_rate_rad_s, -3.0, 3.0)));
  out.add(std::abs(std::clamp(motion.steady_body_turn_rad, -1.2, 1.2)));
  // The share of the speed that is lost; for a corner too, but there the chest turns.
  const double swing = std::abs(motion.body_swing_rad.back());
  const double straight = std::exp(-square(swing / 0.35));
  const double speed = motion.measured.velocity_m_s.norm();
  double lost = 0.0;
  for (const double fall_m_s : motion.recent_fall_m_s) {
    lost = std::clamp(fall_m_s / std::max(speed + fall_m_s, 0.3), -1.0, 1.0);
    out.add(2.0 * lost);
  }
  out.add(5.0 * straight * positive(lost));
  out.add(5.0 * straight * square(positive(lost)));
  out.add(std::min(swing, 1.5));
  out.add(std::clamp(motion.soon_fall_m_s, -1.0, 1.0));
  out.add(motion.log_stops_per_s);
  out.add(motion.log_turns_per_s);
  if (!map_known) return;
  const double obstacle_s = time_to_obstacle_s(motion, surroundings);
  out.add(std::clamp(assessment[Intention::kDecelerate].potential, 0.0, 3.0));
  out.add(std::exp(-obstacle_s / 0.4));
  out.add(std::exp(-obstacle_s));
  const double widest_m =
      std::max(last_width_m(surroundings.left_width_m), last_width_m(surroundings.right_width_m));
  out.add(std::exp(-obstacle_s) * widest_m / Surroundings::kSideRange_m);
}

}  // namespace

IntentionFeatures intention_features(const MotionCues& motion, const Surroundings& surroundings,
                                     const IntentionAssessment& assessment, bool map_known) {
  IntentionFeatures f;
  f.map_known = map_known;
  f.body_known = motion.body_known;
  const ReachableRegion& now = surroundings.region;
  const ReachableRegion& ahead = surroundings.region_ahead;
  const Side left{1.0, assessment[Intention::kTurnLeft], now.left_half_angle_rad,
                  ahead.left_half_angle_rad, surroundings.left_width_m};
  const Side right{-1.0, assessment[Intention::kTurnRight], now.right_half_angle_rad,
                   ahead.right_half_angle_rad, surroundings.right_width_m};
  write_turn(left, right, motion, surroundings, map_known, f.left);
  write_turn(right, left, motion, surroundings, map_known, f.right);
  write_decelerate(motion, surroundings, assessment, map_known, f.decelerate);
  return f;
}

}  // namespace foretrack
