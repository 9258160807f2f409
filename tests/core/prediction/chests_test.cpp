// SPDX-License-Identifier: Apache-2.0
// Whatever somebody's chest does: all paths begin no worse than with the filter's velocity alone,
// but for what it takes to find out.
#include <gtest/gtest.h>

#include <functional>
#include <string>

#include "core/common/random.hpp"
#include "core/prediction/predict.hpp"
#include "tests/core/prediction/worlds.hpp"

namespace foretrack {
namespace {

using testing::walker;

constexpr double kChestStep_s = 0.04, kWalk_s = 60.0, kSpeed_m_s = 2.0, kAhead_s = 0.5;
// Of a second-order filter at 8 rad/s, about as slow as the tracker's.
constexpr double kPositionGain = 0.45, kVelocityGain_hz = 2.56;

struct Chest {
  std::string name;
  double lead_s = 0.3;
  double aside_rad = 0.0;
  double sway_rad = 0.0;
  double flipped_share = 0.0;
};

const std::vector<Chest> kChests = {{"as fitted"},
                                    {"backwards", 0.3, kPi},
                                    {"69 degrees aside", 0.3, rad(69.0)},
                                    {"follows by 0.2 s", -0.2},
                                    {"sways by 40 degrees", 0.3, 0.0, rad(40.0)},
                                    {"23 degrees aside", 0.3, rad(23.0)},
                                    {"flips now and then", 0.3, 0.0, 0.0, 0.3},
                                    {"follows, and points to the right", -0.2, rad(-90.0)}};

// Turns of 50 to 130° every 2 to 4 s, at 3.5 rad/s.
class Course {
 public:
  explicit Course(std::uint64_t seed) {
    Random random(seed);
    double time_s = 2.0;
    while (time_s < kWalk_s + 2.0) {
      const double turn_rad = rad(random.uniform(50.0, 130.0)) * (random.chance(0.5) ? 1.0 : -1.0);
      turns_.push_back({time_s, turn_rad});
      time_s += random.uniform(2.0, 4.0);
    }
  }
  double at_rad(double time_s) const {
    double course_rad = 0.0;
    for (const auto& [begin_s, turn_rad] : turns_)
      course_rad += std::clamp(3.5 * (time_s - begin_s), 0.0, std::abs(turn_rad)) *
                    (turn_rad < 0.0 ? -1.0 : 1.0);
    return course_rad;
  }
  Vec2 velocity_m_s(double time_s) const { return kSpeed_m_s * direction_of(at_rad(time_s)); }

 private:
  std::vector<std::pair<double, double>> turns_;
};

// The chest as it is measured, with 5° of noise, flipped in spells of half a second.
class SeenChest {
 public:
  SeenChest(const Chest& chest, std::uint64_t seed) : chest_(chest), random_(seed) {}
  double yaw_rad(const Course& course, double time_s) {
    if (time_s >= next_s_) {
      flipped_ = random_.chance(chest_.flipped_share);
      next_s_ = time_s + 0.5;
    }
    return wrap_angle(course.at_rad(time_s + chest_.lead_s) + chest_.aside_rad +
                      chest_.sway_rad * std::sin(kPi * time_s) + (flipped_ ? kPi : 0.0) +
                      rad(5.0) * random_.normal());
  }

 private:
  Chest chest_;
  Random random_;
  double next_s_ = 0.0;
  bool flipped_ = false;
};

struct Errors {
  double told_m2 = 0.0, filter_m2 = 0.0;
};

// Squared errors of where paths begin, half a second ahead.
Errors walk(const Chest& chest, std::uint64_t seed) {
  const Course course(seed);
  const PredictionParams params;
  SeenChest seen(chest, seed);
  Random noise(seed + 50);
  MotionMemory memory;
  Errors errors;
  PlanarState filtered{Vec2::Zero(), course.velocity_m_s(0.0)};
  Vec2 place_m = Vec2::Zero();
  std::vector<std::pair<Vec2, Vec2>> told;  // by network and filter, one a step
  for (int k = 1; k * kChestStep_s < kWalk_s; ++k) {
    const double t = k * kChestStep_s;
    place_m += kChestStep_s * course.velocity_m_s(t);
    const Vec2 measured_m = place_m + 0.03 * Vec2(noise.normal(), noise.normal());
    filtered = advance(MotionModel::constant_velocity(), filtered, kChestStep_s);
    const Vec2 innovation_m = measured_m - filtered.position_m;
    filtered.position_m += kPositionGain * innovation_m;
    filtered.velocity_m_s += kVelocityGain_hz * innovation_m;
    TargetState target = walker(filtered.position_m, filtered.velocity_m_s, t);
    target.body_yaw_rad = seen.yaw_rad(course, t);
    const PlanarState soon = observe_motion(memory, target, params).soon;
    told.emplace_back(soon.position_m + (kAhead_s - ShortTermMotion::kSoon_s) * soon.velocity_m_s,
                      filtered.position_m + kAhead_s * filtered.velocity_m_s);
    const int then = k - 1 - static_cast<int>(kAhead_s / kChestStep_s + 0.5);
    if (then < 0) continue;
    errors.told_m2 += (told[static_cast<std::size_t>(then)].first - place_m).squaredNorm();
    errors.filter_m2 += (told[static_cast<std::size_t>(then)].second - place_m).squaredNorm();
  }
  return errors;
}

TEST(Chests, NoneMakesTheNextMomentWorseThanTheFilterAlone) {
  for (const Chest& chest : kChests) {
    Errors sum;
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
      const Errors one = walk(chest, seed);
      sum.told_m2 += one.told_m2;
      sum.filter_m2 += one.filter_m2;
    }
    EXPECT_LT(std::sqrt(sum.told_m2), 1.04 * std::sqrt(sum.filter_m2)) << chest.name;
  }
}

TEST(Chests, OneThatLeadsIsWorthReadingWhereverItPoints) {
  for (const Chest& chest : kChests) {
    if (chest.lead_s < 0.0 || chest.sway_rad > 0.0 || chest.flipped_share > 0.0) continue;
    const Errors one = walk(chest, 5);
    EXPECT_LT(std::sqrt(one.told_m2), 0.75 * std::sqrt(one.filter_m2)) << chest.name;
  }
}

TEST(Chests, IntentionsAreToldWithoutOneThatNeverCameTrue) {
  PredictionState state;
  const PredictionParams params;
  const GridMap map = testing::open_field();
  double most = 0.0;
  for (double t = kChestStep_s; t < 6.0; t += kChestStep_s) {
    // Straight on along x, the chest swaying by 60° at 0.5 Hz.
    TargetState target = walker({-6.0 + 1.5 * t, 0.0}, {1.5, 0.0}, t);
    target.body_yaw_rad = rad(60.0) * std::sin(kPi * t);
    const PredictionResult& result = predict(state, target, map, params);
    if (t < 3.0) continue;
    most = std::max({most, result.intention[Intention::kTurnLeft].probability,
                     result.intention[Intention::kTurnRight].probability});
  }
  EXPECT_LT(most, 0.5);
}

}  // namespace
}  // namespace foretrack
