// SPDX-License-Identifier: Apache-2.0
#include "services/convert/px4_home.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/common/frames.hpp"
#include "services/convert/px4_command.hpp"

namespace foretrack {
namespace {

namespace msg = px4_msgs::msg;

constexpr double kEarth_m = 6371000.0;  // radius, as PX4's projection takes it
constexpr double kDegree_rad = kPi / 180.0;
constexpr double kMostAltitude_m = 1e4;

bool is_on_earth(double lat_deg, double lon_deg, double alt_m) {
  return std::abs(lat_deg) <= 90.0 && std::abs(lon_deg) <= 180.0 &&
         std::abs(alt_m) <= kMostAltitude_m;
}

}  // namespace

GlobalPlace global_of(const GlobalPlace& origin, const Vec3& place_enu_m) {
  const double lat0 = origin.lat_deg * kDegree_rad, lon0 = origin.lon_deg * kDegree_rad;
  const double north = place_enu_m.y() / kEarth_m, east = place_enu_m.x() / kEarth_m;
  const double arc = std::hypot(north, east);
  const double sine = arc > 0.0 ? std::sin(arc) / arc : 1.0;
  const double lat = std::asin(
      std::clamp(std::cos(arc) * std::sin(lat0) + north * sine * std::cos(lat0), -1.0, 1.0));
  const double lon = lon0 + std::atan2(east * sine, std::cos(lat0) * std::cos(arc) -
                                                        north * std::sin(lat0) * sine);
  return {lat / kDegree_rad, wrap_angle(lon) / kDegree_rad, origin.alt_m + place_enu_m.z()};
}

Vec3 local_of(const GlobalPlace& origin, const GlobalPlace& place) {
  const double lat0 = origin.lat_deg * kDegree_rad, lat = place.lat_deg * kDegree_rad;
  const double turn = (place.lon_deg - origin.lon_deg) * kDegree_rad;
  const double cosine =
      std::sin(lat0) * std::sin(lat) + std::cos(lat0) * std::cos(lat) * std::cos(turn);
  const double arc = std::acos(std::clamp(cosine, -1.0, 1.0));
  const double scale = kEarth_m * (arc > 0.0 ? arc / std::sin(arc) : 1.0);
  return {
      scale * std::cos(lat) * std::sin(turn),
      scale * (std::cos(lat0) * std::sin(lat) - std::sin(lat0) * std::cos(lat) * std::cos(turn)),
      place.alt_m - origin.alt_m};
}

std::optional<GlobalPlace> origin_of(const msg::VehicleLocalPosition& in) {
  if (!in.xy_global() || !in.z_global() || !is_on_earth(in.ref_lat(), in.ref_lon(), in.ref_alt()))
    return std::nullopt;
  return GlobalPlace{in.ref_lat(), in.ref_lon(), in.ref_alt()};
}

void set_origin(const GlobalPlace& origin, msg::VehicleLocalPosition& out) {
  out.xy_global(true);
  out.z_global(true);
  out.ref_lat(origin.lat_deg);
  out.ref_lon(origin.lon_deg);
  out.ref_alt(static_cast<float>(origin.alt_m));
}

Converted<Vec3> from_idl(const msg::HomePosition& in) {
  Checks checks;
  const Vec3 home_ned_m(in.x(), in.y(), in.z());
  if (!in.valid_lpos()) checks.fail("valid_lpos", "false", "a home in the local frame");
  for (const double value : home_ned_m) checks.within("x, y, z", value, limits::kPosition_m);
  return checks.result(swap_enu_ned(home_ned_m));
}

void to_idl(const GlobalPlace& origin, const Vec3& home_enu_m, double stamp_s,
            msg::HomePosition& out) {
  const GlobalPlace home = global_of(origin, home_enu_m);
  const Vec3 home_ned_m = swap_enu_ned(home_enu_m);
  out.timestamp(static_cast<std::uint64_t>(std::llround(stamp_s * 1e6)));
  out.lat(home.lat_deg);
  out.lon(home.lon_deg);
  out.alt(static_cast<float>(home.alt_m));
  out.x(static_cast<float>(home_ned_m.x()));
  out.y(static_cast<float>(home_ned_m.y()));
  out.z(static_cast<float>(home_ned_m.z()));
  out.yaw(std::numeric_limits<float>::quiet_NaN());
  out.valid_alt(true);
  out.valid_hpos(true);
  out.valid_lpos(true);
}

void to_set_home(const GlobalPlace& place, int system_id, double stamp_s,
                 msg::VehicleCommand& out) {
  to_idl(AutopilotCommand{.target_system = system_id}, stamp_s, out);
  out.command(msg::VehicleCommand_Constants::VEHICLE_CMD_DO_SET_HOME);
  out.param1(0.0f);  // the place below, not where the vehicle is
  out.param2(0.0f);
  out.param3(0.0f);
  out.param4(std::numeric_limits<float>::quiet_NaN());  // its yaw is free
  out.param5(place.lat_deg);
  out.param6(place.lon_deg);
  out.param7(static_cast<float>(place.alt_m));
}

std::optional<GlobalPlace> home_asked_by(const msg::VehicleCommand& in) {
  const bool asks =
      in.command() == msg::VehicleCommand_Constants::VEHICLE_CMD_DO_SET_HOME && in.param1() == 0.0f;
  if (!asks || !is_on_earth(in.param5(), in.param6(), in.param7())) return std::nullopt;
  return GlobalPlace{in.param5(), in.param6(), in.param7()};
}

}  // namespace foretrack
