// SPDX-License-Identifier: Apache-2.0
#include "core/simulator/people_detector.hpp"

#include <algorithm>

namespace foretrack {
namespace {

constexpr double kSideNoiseAt_m = 4.0;

bool hides(const Cylinder& shape, const Vec3& from, const Vec3& to) {
  const Vec3 way = to - from;
  return ray_distance_m(shape, from, way.normalized()) < way.norm();
}

struct Look {
  const PeopleDetectorParams& params;
  const World& world;
  std::span<const Person> people;
  const Cylinder& followed;
  Pose T_world_camera;

  bool images(const Vec3& point) const {
    const Vec3 in_camera = T_world_camera.inverse() * point;
    if (in_camera.norm() > params.range_max_m) return false;
    if (params.all_round) return true;
    const auto px = params.camera.project(in_camera);
    return px && params.camera.contains(*px);
  }
  bool sees(const Vec3& point, std::size_t whose) const {
    const Vec3 eye = T_world_camera.translation();
    if (!images(point) || hides(followed, eye, point) || !line_of_sight(world, eye, point))
      return false;
    for (std::size_t i = 0; i < people.size(); ++i)
      if (i != whose && hides(cylinder_of(people[i].state, people[i].params.height_m), eye, point))
        return false;
    return true;
  }
  bool sees(std::size_t whose) const {
    const Person& person = people[whose];
    int seen = 0;
    for (const Vec3& point : body_points_enu_m(person.state, person.params.height_m))
      seen += sees(point, whose);
    return 2 * seen >= 5;
  }
};

BodySighting measure(const PeopleDetectorParams& p, const Vec3& eye, const Person& person,
                     Random& random) {
  const Vec3 foot = foot_enu_m(person.state, person.params.height_m);
  const Vec2 along = (foot - eye).head<2>();
  const double far_m = along.norm();
  const Vec2 u = far_m > 1e-6 ? Vec2(along / far_m) : Vec2::UnitX();
  const Vec2 side(-u.y(), u.x());
  const double range_m = p.range_noise * far_m;
  const double side_m = p.side_noise_m * std::max(1.0, far_m / kSideNoiseAt_m);
  BodySighting seen;
  seen.kind = BodyKind::kPerson;
  seen.position_enu_m = foot;
  seen.position_enu_m.head<2>() += range_m * random.normal() * u + side_m * random.normal() * side;
  seen.covariance_m2 =
      range_m * range_m * u * u.transpose() + side_m * side_m * side * side.transpose();
  seen.radius_m = kPersonRadius_m;
  seen.height_m = person.params.height_m + p.height_noise_m * random.normal();
  return seen;
}

}  // namespace

PeopleDetector make_people_detector(const PeopleDetectorParams& params, std::uint64_t seed) {
  return {.params = params, .random = Random(seed), .waiting = {}};
}

bool is_in_sight(const PeopleDetectorParams& params, const World& world,
                 const VehicleState& vehicle, std::span<const Person> people,
                 const Cylinder& followed, std::size_t whose) {
  const Look look{params, world, people, followed,
                  vehicle.T_world_body() * params.camera.T_body_camera};
  return look.sees(whose);
}

std::optional<BodySightings> detect(PeopleDetector& detector, const World& world,
                                    const VehicleState& vehicle, std::span<const Person> people,
                                    const Cylinder& followed) {
  const PeopleDetectorParams& p = detector.params;
  const double now_s = vehicle.stamp_s;
  if (now_s >= detector.next_image_s - 1e-9) {
    detector.next_image_s += 1.0 / p.rate_hz;
    const Look look{p, world, people, followed, vehicle.T_world_body() * p.camera.T_body_camera};
    BodySightings& seen = detector.waiting.emplace_back();
    seen.stamp_s = now_s;
    for (std::size_t i = 0; i < people.size(); ++i)
      if (!detector.random.chance(p.dropout) && look.sees(i))
        seen.add(measure(p, look.T_world_camera.translation(), people[i], detector.random));
  }
  if (detector.waiting.empty() || now_s < detector.waiting.front().stamp_s + p.delay_s - 1e-9)
    return std::nullopt;
  const BodySightings delivered = detector.waiting.front();
  detector.waiting.erase(detector.waiting.begin());
  return delivered;
}

}  // namespace foretrack
