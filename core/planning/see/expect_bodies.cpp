// SPDX-License-Identifier: Apache-2.0
#include "core/planning/see/expect_bodies.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/common/ground.hpp"

namespace foretrack {
namespace {

constexpr double kTorsoShare = 0.674;  // the torso's centre is so high, in body heights
constexpr double kTorsoSlack_m = 0.5;  // ground further from where it should be is not believed
constexpr double kWidestDoubt_m = 0.3;
constexpr double kVelocityStep_s = 0.05;
constexpr double kUnseenSpread_m_s = 0.5;  // of a person who is not seen any more, at first
constexpr double kWidestUnseen_m = 0.5;
constexpr double kStillSeen_s = 0.1;
constexpr double kFarthestBelow_m = 2.5;
constexpr double kPlaceStep_s =
    0.25;  // the last places are beyond the end of any path: it stands there
constexpr double kVehicleSpeed_m_s = 3.0;  // at which vehicle and body may close in, with their own

// One standard deviation, in the mean over both axes.
double doubt_m(const MovingBody& body) {
  const double variance_m2 = 0.5 * std::max(body.position_covariance_m2.trace(), 0.0);
  return std::min(std::sqrt(variance_m2), kWidestDoubt_m);
}

bool is_far(const MovingBody& body, const Vec3& vehicle, const GapParams& params) {
  const double closing_m_s =
      kVehicleSpeed_m_s + std::max(body.velocity_enu_m_s.norm(), params.body_speed_m_s);
  return distance_xy(body.position_enu_m, vehicle) >
         closing_m_s * params.body_horizon_s + params.gap_wanted_m + body.radius_m;
}

double foot_z(const GridMap* map, const Vec3& torso, double height_m) {
  const double expected_m = torso.z() - kTorsoShare * height_m;
  if (map == nullptr) return expected_m;
  const std::optional<double> ground_m = ground_below_m(*map, torso);
  return ground_m && std::abs(*ground_m - expected_m) < kTorsoSlack_m ? *ground_m : expected_m;
}

struct Person {
  std::uint32_t id = 0;
  double radius_m, height_m;
};

// How far somebody who is not seen any more may be from where they were expected.
double unseen_doubt_m(double age_s) {
  return std::clamp(kUnseenSpread_m_s * (age_s - kStillSeen_s), 0.0, kWidestUnseen_m);
}

// The followed person on one believed path, as of now: an old belief (of a lost target) says about
// where they are expected now, not that they may have run since then wherever they could.
MovingBody body_on(const PredictedPath& path, double age_s, double now_s, const Person& person,
                   const GridMap* map) {
  MovingBody body;
  body.id = person.id;
  body.radius_m = person.radius_m + unseen_doubt_m(age_s);
  body.height_m = person.height_m;
  body.followed = true;
  body.kind = BodyKind::kPerson;
  body.stamp_s = now_s;
  const auto place = [&](double time_s) {
    const Vec3 torso = position_on(path, time_s);
    return Vec3(torso.x(), torso.y(), foot_z(map, torso, person.height_m));
  };
  body.position_enu_m = place(age_s);
  body.velocity_enu_m_s =
      (position_on(path, age_s + kVelocityStep_s) - position_on(path, age_s)) / kVelocityStep_s;
  body.velocity_enu_m_s.z() = 0.0;
  body.step_s = kPlaceStep_s;
  body.place_count = MovingBody::kMaxPlaces;
  for (int k = 0; k < body.place_count; ++k)
    body.places_enu_m[k] = place(age_s + kPlaceStep_s * (k + 1));
  return body;
}

// Whom the vehicle flies above, out of its camera's sight, may have turned round or stopped right
// below: they are anywhere within a walk of where they were seen last, and nothing sinks on them.
std::optional<MovingBody> somewhere_below(const PlanInput& input, const TargetBelief& belief,
                                          const Person& person, const GapParams& params) {
  const double age_s = input.now_s - belief.stamp_s;
  if (belief.count == 0 || age_s < kStillSeen_s) return {};
  MovingBody body = body_on(belief.paths[0], 0.0, input.now_s, person, input.map);
  const double head_m = body.position_enu_m.z() + person.height_m;
  if (input.vehicle.position_enu_m.z() - params.hull_radius_m < head_m) return {};
  body.radius_m = person.radius_m + std::min(params.body_speed_m_s * age_s, kFarthestBelow_m);
  body.velocity_enu_m_s.setZero();
  body.place_count = 0;
  return body;
}

void add_followed(const PlanInput& input, const TargetBelief& belief, const Person& person,
                  const GapParams& params, BodyCourses& courses) {
  if (const auto below = somewhere_below(input, belief, person, params))
    courses.add({*below, 1.0, params.body_horizon_s});
  for (int i = 0; i < belief.count; ++i) {
    const PredictedPath& path = belief.paths[i];
    if (i > 0 && path.probability < params.course_probability_min) continue;
    const double horizon_s = i == 0 ? params.body_horizon_s : params.unlikely_horizon_s;
    const double age_s = std::max(input.now_s - belief.stamp_s, 0.0);
    courses.add(
        {body_on(path, age_s, input.now_s, person, input.map), path.probability, horizon_s});
  }
}

}  // namespace

void expect_bodies(const PlanInput& input, const TargetBelief* belief, const GapParams& params,
                   BodyCourses& courses) {
  courses.count = 0;
  Person person{0, params.person_radius_m, params.person_height_m};
  if (input.bodies != nullptr)
    for (const MovingBody& body : input.bodies->all()) {
      if (body.followed) {
        person = {body.id, body.radius_m, body.height_m};
        if (belief != nullptr) continue;
      }
      if (is_far(body, input.vehicle.position_enu_m, params)) continue;
      courses.add({body, 1.0, params.body_horizon_s});
      courses.courses[courses.count - 1].body.radius_m += doubt_m(body);
    }
  if (belief != nullptr) add_followed(input, *belief, person, params, courses);
}

}  // namespace foretrack
