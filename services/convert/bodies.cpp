// SPDX-License-Identifier: Apache-2.0
#include "services/convert/bodies.hpp"

#include "services/convert/geometry.hpp"

namespace foretrack {
namespace {

namespace msg = foretrack_msgs::msg;
namespace kinds = msg::MovingBody_Constants;
static_assert(kinds::KIND_PERSON == int(BodyKind::kPerson));
static_assert(kinds::KIND_VEHICLE == int(BodyKind::kVehicle));
static_assert(kinds::KIND_UNKNOWN == int(BodyKind::kUnknown));

constexpr double kMostSize_m = 20.0;
constexpr double kMostStep_s = 10.0;

void check_size(Checks& checks, double radius_m, double height_m) {
  checks.positive("bodies.radius_m", radius_m, kMostSize_m);
  checks.positive("bodies.height_m", height_m, kMostSize_m);
}

void write_landmarks(const PersonLook& look, std::vector<msg::Landmark>& out) {
  out.resize(kLandmarkCount);
  for (int i = 0; i < kLandmarkCount; ++i) {
    const Landmark& mark = look.landmarks[i];
    out[i].image_x_px(static_cast<float>(mark.image_px.x()));
    out[i].image_y_px(static_cast<float>(mark.image_px.y()));
    out[i].visibility(static_cast<float>(mark.visibility));
    out[i].body_x_m(static_cast<float>(mark.body_m.x()));
    out[i].body_y_m(static_cast<float>(mark.body_m.y()));
    out[i].body_z_m(static_cast<float>(mark.body_m.z()));
  }
}

void write_look(const PersonLook& look, double stamp_s, msg::MovingBody& out) {
  out.look_age_s(look.known() ? stamp_s - look.stamp_s : -1.0);
  out.box_px(
      {look.box_low_px.x(), look.box_low_px.y(), look.box_high_px.x(), look.box_high_px.y()});
  if (look.has_landmarks)
    write_landmarks(look, out.landmarks());
  else
    out.landmarks().clear();
  out.body_yaw_rad(look.body_yaw_rad);
  out.head_yaw_rad(look.head_yaw_rad);
}

void write_body(const MovingBody& body, msg::MovingBody& out) {
  out.id(body.id);
  out.kind(static_cast<std::uint8_t>(body.kind));
  out.followed(body.followed);
  out.position_m(to_array(body.position_enu_m));
  out.velocity_mps(to_array(body.velocity_enu_m_s));
  out.position_covariance_m2(to_rows<2>(body.position_covariance_m2));
  out.velocity_covariance_m2_s2(to_rows<2>(body.velocity_covariance_m2_s2));
  out.radius_m(body.radius_m);
  out.height_m(body.height_m);
  out.place_step_s(body.step_s);
  out.places_m().resize(static_cast<std::size_t>(body.place_count));
  for (int k = 0; k < body.place_count; ++k) {
    const Vec3& place_m = body.places_enu_m[k];
    out.places_m()[k].x(place_m.x());
    out.places_m()[k].y(place_m.y());
    out.places_m()[k].z(place_m.z());
  }
}

void read_places(Checks& checks, const msg::MovingBody& in, MovingBody& out) {
  checks.positive("bodies.place_step_s", in.place_step_s(), kMostStep_s);
  checks.count("bodies.places_m", in.places_m().size(), 0, MovingBody::kMaxPlaces);
  if (!checks.ok()) return;
  out.step_s = in.place_step_s();
  for (const auto& place : in.places_m()) {
    for (const double v : {place.x(), place.y(), place.z()})
      checks.within("bodies.places_m", v, limits::kPosition_m);
    out.places_enu_m[out.place_count++] = {place.x(), place.y(), place.z()};
  }
}

MovingBody read_body(Checks& checks, const msg::MovingBody& in, double stamp_s) {
  MovingBody out;
  checks.enumerator("bodies.kind", in.kind(), kinds::KIND_UNKNOWN);
  checks.within("bodies.position_m", in.position_m(), limits::kPosition_m);
  checks.within("bodies.velocity_mps", in.velocity_mps(), limits::kSpeed_m_s);
  checks.covariance("bodies.position_covariance_m2", in.position_covariance_m2().data(), 2);
  checks.covariance("bodies.velocity_covariance_m2_s2", in.velocity_covariance_m2_s2().data(), 2);
  check_size(checks, in.radius_m(), in.height_m());
  read_places(checks, in, out);
  out.id = in.id();
  out.kind = static_cast<BodyKind>(in.kind());
  out.followed = in.followed();
  out.stamp_s = stamp_s;
  out.position_enu_m = to_vec3(in.position_m());
  out.velocity_enu_m_s = to_vec3(in.velocity_mps());
  out.position_covariance_m2 = from_rows<2>(in.position_covariance_m2());
  out.velocity_covariance_m2_s2 = from_rows<2>(in.velocity_covariance_m2_s2());
  out.radius_m = in.radius_m();
  out.height_m = in.height_m();
  return out;
}

BodySighting read_sighting(Checks& checks, const msg::BodySighting& in) {
  checks.enumerator("bodies.kind", in.kind(), kinds::KIND_UNKNOWN);
  checks.within("bodies.position_m", in.position_m(), limits::kPosition_m);
  checks.covariance("bodies.covariance_m2", in.covariance_m2().data(), 2);
  check_size(checks, in.radius_m(), in.height_m());
  return {static_cast<BodyKind>(in.kind()), to_vec3(in.position_m()),
          from_rows<2>(in.covariance_m2()), in.radius_m(), in.height_m()};
}

}  // namespace

void to_idl(const MovingBodies& in, std::span<const PersonLook> looks, msg::MovingBodies& out) {
  set_header(out.header(), in.stamp_s);
  out.bodies().resize(static_cast<std::size_t>(in.count));
  const PersonLook none;
  for (std::size_t i = 0; i < out.bodies().size(); ++i) {
    write_body(in.bodies[i], out.bodies()[i]);
    write_look(looks.empty() ? none : looks[i], in.stamp_s, out.bodies()[i]);
  }
}

Converted<MovingBodies> from_idl(const msg::MovingBodies& in) {
  Checks checks;
  MovingBodies out;
  check_header(checks, in.header());
  checks.count("bodies", in.bodies().size(), 0, MovingBodies::kCapacity);
  if (!checks.ok()) return checks.result(out);
  out.stamp_s = seconds(in.header().stamp());
  int followed = 0;
  for (const auto& body : in.bodies()) {
    out.add(read_body(checks, body, out.stamp_s));
    followed += body.followed();
  }
  checks.in_range("bodies.followed", followed, 0, 1);
  return checks.result(out);
}

void to_idl(const BodySightings& in, msg::BodySightings& out) {
  set_header(out.header(), in.stamp_s);
  out.bodies().resize(static_cast<std::size_t>(in.count));
  for (std::size_t i = 0; i < out.bodies().size(); ++i) {
    const BodySighting& body = in.bodies[i];
    auto& row = out.bodies()[i];
    row.kind(static_cast<std::uint8_t>(body.kind));
    row.position_m(to_array(body.position_enu_m));
    row.covariance_m2(to_rows<2>(body.covariance_m2));
    row.radius_m(body.radius_m);
    row.height_m(body.height_m);
  }
}

Converted<BodySightings> from_idl(const msg::BodySightings& in) {
  Checks checks;
  BodySightings out;
  check_header(checks, in.header());
  checks.count("bodies", in.bodies().size(), 0, BodySightings::kCapacity);
  if (!checks.ok()) return checks.result(out);
  out.stamp_s = seconds(in.header().stamp());
  for (const auto& body : in.bodies()) out.add(read_sighting(checks, body));
  return checks.result(out);
}

}  // namespace foretrack
