// SPDX-License-Identifier: Apache-2.0
#include "core/bodies/track_bodies.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <set>

#include "core/bodies/bodies_around.hpp"
#include "core/common/random.hpp"
#include "tests/support/count_allocations.hpp"

namespace foretrack {
namespace {

constexpr double kFrame_s = 1.0 / 15.0;
constexpr double kNoise_m = 0.08;
const Vec3 kVehicle(0.0, 0.0, 1.5);

using Path = std::function<Vec2(double)>;

BodySighting sighting_at(const Vec2& place_m, BodyKind kind = BodyKind::kPerson) {
  BodySighting seen;
  seen.kind = kind;
  seen.position_enu_m << place_m, 0.0;
  seen.covariance_m2 = kNoise_m * kNoise_m * Mat2::Identity();
  return seen;
}

/// A detector that sees people along their paths, with noise.
struct Watch {
  BodyParams params;
  BodiesState state;
  TargetState target;
  Random random{7};
  BodyKind kind = BodyKind::kPerson;
  double now_s = 0.0;

  Vec2 noise() { return kNoise_m * Vec2(random.normal(), random.normal()); }
  /// One frame of those whose visible() holds.
  void look(const std::vector<Path>& paths,
            const std::function<bool(int, const Vec2&)>& visible = {}) {
    now_s += kFrame_s;
    BodySightings seen;
    seen.stamp_s = now_s;
    for (int i = 0; i < static_cast<int>(paths.size()); ++i) {
      const Vec2 place_m = paths[i](now_s);
      if (!visible || visible(i, place_m)) seen.add(sighting_at(place_m + noise(), kind));
    }
    track_bodies(state, seen, target, params);
  }
  MovingBodies around(double later_s = 0.0) {
    MovingBodies bodies;
    bodies_around(state, now_s + later_s, {target}, kVehicle, params, bodies);
    return bodies;
  }
};

Path straight(const Vec2& from_m, const Vec2& velocity_m_s) {
  return [=](double t) -> Vec2 { return from_m + t * velocity_m_s; };
}

const MovingBody* nearest_to(const MovingBodies& bodies, const Vec2& place_m, double within_m) {
  const MovingBody* nearest = nullptr;
  for (const MovingBody& body : bodies.all()) {
    const double distance_m = (body.position_enu_m.head<2>() - place_m).norm();
    if (distance_m < within_m) nearest = &body, within_m = distance_m;
  }
  return nearest;
}

TEST(TrackBodies, BelievesAPersonAfterThreeSightings) {
  Watch w;
  const Path path = straight({4, -2}, {0, 1.5});
  w.look({path});
  w.look({path});
  EXPECT_EQ(w.around().count, 0);
  w.look({path});
  ASSERT_EQ(w.around().count, 1);
  EXPECT_EQ(w.around().bodies[0].kind, BodyKind::kPerson);
  EXPECT_FALSE(w.around().bodies[0].followed);
}

TEST(TrackBodies, KnowsPlaceAndVelocityOfWhoWalks) {
  for (const double speed_m_s : {1.0, 2.0, 3.0}) {
    Watch w;
    const Path path = straight({4, -3}, {0, speed_m_s});
    for (int k = 0; k < 15; ++k) w.look({path});
    const MovingBodies bodies = w.around();
    ASSERT_EQ(bodies.count, 1);
    EXPECT_LT((bodies.bodies[0].position_enu_m.head<2>() - path(w.now_s)).norm(), 0.12);
    EXPECT_LT((bodies.bodies[0].velocity_enu_m_s - Vec3(0, speed_m_s, 0)).norm(), 0.5);
  }
}

// Normalised estimation error squared: 4 on average if the covariance says what the error is. A
// walk of constant velocity is easier than the noise that the filter reckons with.
TEST(TrackBodies, CovarianceCoversTheError) {
  double sum_position = 0.0, sum_velocity = 0.0;
  constexpr int kRuns = 60;
  for (int run = 0; run < kRuns; ++run) {
    Watch w;
    w.random = Random(100 + run);
    const Path path = straight({5, -2}, {-0.5, 1.4});
    for (int k = 0; k < 20; ++k) w.look({path});
    const MovingBody body = w.around().bodies[0];
    const Vec2 off_m = body.position_enu_m.head<2>() - path(w.now_s);
    const Vec2 off_m_s = body.velocity_enu_m_s.head<2>() - Vec2(-0.5, 1.4);
    sum_position += off_m.dot(body.position_covariance_m2.inverse() * off_m);
    sum_velocity += off_m_s.dot(body.velocity_covariance_m2_s2.inverse() * off_m_s);
  }
  EXPECT_LT(sum_position / kRuns, 2.5);
  EXPECT_GT(sum_position / kRuns, 0.5);
  EXPECT_LT(sum_velocity / kRuns, 2.5);
}

TEST(TrackBodies, NumbersStayWhenTwoCross) {
  Watch w;
  const std::vector<Path> paths = {straight({3, -2}, {0, 1.2}), straight({3.6, 2}, {0, -1.2})};
  for (int k = 0; k < 6; ++k) w.look(paths);
  const std::uint32_t first = nearest_to(w.around(), paths[0](w.now_s), 0.4)->id;
  const std::uint32_t second = nearest_to(w.around(), paths[1](w.now_s), 0.4)->id;
  ASSERT_NE(first, second);
  while (w.now_s < 3.3) w.look(paths);
  const MovingBodies bodies = w.around();
  ASSERT_EQ(bodies.count, 2);
  EXPECT_EQ(nearest_to(bodies, paths[0](w.now_s), 0.4)->id, first);
  EXPECT_EQ(nearest_to(bodies, paths[1](w.now_s), 0.4)->id, second);
}

TEST(TrackBodies, GoesOnBehindAPillarAndIsTheSameAfterIt) {
  Watch w;
  const Path path = straight({4, -2}, {0, 1.5});
  const auto seen = [](int, const Vec2& p) { return std::abs(p.y()) > 0.6; };
  while (path(w.now_s).y() < -0.7) w.look({path}, seen);
  const std::uint32_t id = w.around().bodies[0].id;
  double sigma_before = std::sqrt(w.around().bodies[0].position_covariance_m2(0, 0)), sigma_m = 0.0;
  while (path(w.now_s).y() < 0.5) {
    w.look({path}, seen);
    ASSERT_EQ(w.around().count, 1) << path(w.now_s).transpose();
    EXPECT_LT((w.around().bodies[0].position_enu_m.head<2>() - path(w.now_s)).norm(), 0.5);
    sigma_m = std::sqrt(w.around().bodies[0].position_covariance_m2(0, 0));
  }
  EXPECT_GT(sigma_m, 2.0 * sigma_before) << "hidden, it is less certain";
  while (path(w.now_s).y() < 1.5) w.look({path}, seen);
  ASSERT_EQ(w.around().count, 1);
  EXPECT_EQ(w.around().bodies[0].id, id);
}

TEST(TrackBodies, ForgetsWhoIsNotSeenAnyMore) {
  Watch w;
  const Path path = straight({4, -2}, {0, 1.0});
  for (int k = 0; k < 10; ++k) w.look({path});
  const double last_s = w.now_s;
  while (w.now_s < last_s + w.params.coast_s - kFrame_s) w.look({});
  EXPECT_EQ(w.around().count, 1);
  EXPECT_EQ(w.around(3.0 * kFrame_s).count, 0) << "also when no frame comes";
  for (int k = 0; k < 3; ++k) w.look({});
  EXPECT_EQ(w.around().count, 0);
  EXPECT_EQ(w.state.count, 0);
}

// False sightings here and there for a minute are nobody.
TEST(TrackBodies, ClutterIsNobodyAndDisturbsNobody) {
  Watch w;
  const Path circle = [](double t) -> Vec2 { return Vec2(4.0, 0.0) + 2.0 * direction_of(0.5 * t); };
  int false_bodies = 0;
  std::set<std::uint32_t> ids;
  for (int k = 0; k < 900; ++k) {
    w.now_s += kFrame_s;
    BodySightings seen;
    seen.stamp_s = w.now_s;
    seen.add(sighting_at(circle(w.now_s) + w.noise()));
    if (w.random.chance(0.3))
      seen.add(sighting_at({w.random.uniform(1.0, 8.0), w.random.uniform(-6.0, 6.0)}));
    track_bodies(w.state, seen, w.target, w.params);
    if (k < 3) continue;
    const MovingBodies bodies = w.around();
    const MovingBody* body = nearest_to(bodies, circle(w.now_s), 0.5);
    ASSERT_NE(body, nullptr) << k;
    ids.insert(body->id);
    false_bodies += bodies.count - 1;
  }
  EXPECT_EQ(ids.size(), 1u);
  EXPECT_LT(false_bodies, 18) << "of 900 frames";
}

TEST(TrackBodies, WhatDoesNotMoveIsNoMovingBody) {
  Watch w;
  w.kind = BodyKind::kUnknown;
  for (int k = 0; k < 60; ++k) {
    w.look({straight({3, 1}, {0, 0})});
    EXPECT_EQ(w.around().count, 0) << k;
  }
}

TEST(TrackBodies, WhatMovesIsBelievedAfterAStep) {
  for (const double speed_m_s : {1.0, 2.0, 3.0}) {
    Watch w;
    w.kind = BodyKind::kUnknown;
    const Path path = straight({3, -3}, {0, speed_m_s});
    while (w.around().count == 0 && w.now_s < 2.0) w.look({path});
    EXPECT_LE(w.now_s, 0.5) << speed_m_s;
  }
}

TEST(TrackBodies, SightingsOfTheFollowedPersonAreNobodyElse) {
  Watch w;
  w.target.status = TrackStatus::kTracking;
  w.target.covariance = 0.001 * Mat6::Identity();
  const Path path = straight({3, -3}, {0, 1.5}), beside = straight({3.6, -3}, {0, 1.5});
  for (int k = 0; k < 30; ++k) {
    w.target.stamp_s = w.now_s + kFrame_s;
    w.target.position_enu_m << path(w.target.stamp_s), 1.2;
    w.target.velocity_enu_m_s = {0, 1.5, 0};
    w.look({path, beside});
  }
  const MovingBodies bodies = w.around();
  ASSERT_EQ(bodies.count, 2);
  EXPECT_TRUE(bodies.bodies[0].followed);
  EXPECT_FALSE(bodies.bodies[1].followed);
  EXPECT_LT((bodies.bodies[1].position_enu_m.head<2>() - beside(w.now_s)).norm(), 0.2);
}

TEST(TrackBodies, FramesOfTwoDetectorsMayComeOutOfOrder) {
  Watch w;
  const Path path = straight({4, -2}, {0, 2.0});
  BodySightings late;
  for (int k = 0; k < 20; ++k) {
    w.look({path});
    // A camera whose frames come 0.1 s later.
    late.count = 0;
    late.stamp_s = w.now_s - 0.1;
    late.add(sighting_at(path(late.stamp_s) + w.noise()));
    track_bodies(w.state, late, w.target, w.params);
  }
  ASSERT_EQ(w.around().count, 1);
  EXPECT_LT((w.around().bodies[0].position_enu_m.head<2>() - path(w.now_s)).norm(), 0.1);
  const int hits = w.state.tracks[0].hits;
  late.stamp_s = w.now_s - 2.0 * w.params.late_s + 0.01;
  track_bodies(w.state, late, w.target, w.params);
  EXPECT_EQ(w.state.tracks[0].hits, hits) << "too late to be of use";
}

TEST(TrackBodies, StartsAnewWhenTimeGoesBack) {
  Watch w;
  w.now_s = 100.0;
  for (int k = 0; k < 5; ++k) w.look({straight({3, -100}, {0, 1.0})});
  ASSERT_EQ(w.around().count, 1);
  w.now_s = 1.0;
  w.look({});
  EXPECT_EQ(w.around().count, 0);
}

TEST(TrackBodies, MoreThanFitAreTheNearest) {
  Watch w;
  std::vector<Path> paths;
  for (int i = 0; i < 16; ++i) paths.push_back(straight({2.0 + i, 0}, {0, 1.0}));
  std::vector<Path> others;
  for (int i = 0; i < 10; ++i) others.push_back(straight({2.5 + i, 30}, {0, 1.0}));
  for (int k = 0; k < 4; ++k) {
    w.look(paths);
    w.now_s -= kFrame_s;
    w.look(others);
  }
  const MovingBodies bodies = w.around();
  ASSERT_EQ(bodies.count, MovingBodies::kCapacity);
  for (int i = 0; i < 16; ++i) EXPECT_LT(bodies.bodies[i].position_enu_m.y(), 10.0);
  for (int i = 1; i < 16; ++i)
    EXPECT_LT(bodies.bodies[i - 1].position_enu_m.x(), bodies.bodies[i].position_enu_m.x());
}

TEST(TrackBodies, AllocatesNothing) {
  Watch w;
  BodySightings seen;
  for (int i = 0; i < 16; ++i) seen.add(sighting_at({2.0 + i, 0.0}));
  MovingBodies bodies;
  const long before = allocation_count();
  for (int k = 0; k < 10; ++k) {
    seen.stamp_s = 0.1 * k;
    track_bodies(w.state, seen, w.target, w.params);
    bodies_around(w.state, seen.stamp_s, {w.target}, kVehicle, w.params, bodies);
  }
  EXPECT_EQ(allocation_count(), before);
  EXPECT_EQ(bodies.count, 16);
}

}  // namespace
}  // namespace foretrack
