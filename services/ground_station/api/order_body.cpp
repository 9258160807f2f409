// SPDX-License-Identifier: Apache-2.0
#include "services/ground_station/api/order_body.hpp"

#include <nlohmann/json.hpp>
#include <optional>

#include "services/convert/order_name.hpp"

namespace foretrack::station {
namespace {

using Body = nlohmann::ordered_json;

std::optional<MissionOrder> order_named(const Body& body) {
  const auto it = body.find("command");
  if (it == body.end() || !it->is_string()) return std::nullopt;
  return order_of(it->get<std::string>());
}

// Left as it is where the body has none, or null.
void read_number(Checks& checks, const Body& body, const char* key, double limit, double& value) {
  const auto it = body.find(key);
  if (it == body.end() || it->is_null()) return;
  if (!it->is_number()) return checks.fail(key, it->dump(), "a number or null");
  value = it->get<double>();
  checks.within(key, value, limit);
}

void read_person(Checks& checks, const Body& body, std::uint32_t& id) {
  const auto it = body.find("person_id");
  const bool sound = it != body.end() && it->is_number_unsigned() && *it <= 0xffffffffu;
  if (!sound) return checks.fail("person_id", it == body.end() ? "none" : it->dump(), "a number");
  id = it->get<std::uint32_t>();
}

void read_place(Checks& checks, const Body& place, const char* key, FlightBounds::Corner& out) {
  const bool is_pair =
      place.is_array() && place.size() == 2 && place[0].is_number() && place[1].is_number();
  if (!is_pair) return checks.fail(key, place.dump(), "[x, y]");
  out = {place[0].get<double>(), place[1].get<double>()};
  checks.within(key, out.x_m, limits::kPosition_m);
  checks.within(key, out.y_m, limits::kPosition_m);
}

void read_fence(Checks& checks, const Body& body, FlightBounds& bounds) {
  const auto it = body.find("fence_m");
  if (it == body.end() || it->is_null()) return;
  if (!it->is_array() || it->size() > FlightBounds::kMaxCorners)
    return checks.fail("fence_m", "no list of that", "32 corners at most");
  for (const Body& corner : *it)
    read_place(checks, corner, "fence_m", bounds.corners_enu_m[bounds.corner_count++]);
}

}  // namespace

Converted<MissionCommand> read_order(const Body& body) {
  Checks checks;
  MissionCommand command;
  const auto order = order_named(body);
  if (!order)
    checks.fail("command", "no such thing",
                "start, hold, resume, return, land, stop, take_off, follow, framing, bounds or "
                "return_place");
  command.order = order.value_or(MissionOrder::kStop);
  if (order == MissionOrder::kFollow) read_person(checks, body, command.person_id);
  if (order == MissionOrder::kSetFraming) {
    Framing& framing = command.framing;
    read_number(checks, body, "distance_m", limits::kPosition_m, framing.distance_m);
    read_number(checks, body, "height_m", limits::kPosition_m, framing.height_m);
    read_number(checks, body, "bearing_rad", limits::kAngle_rad, framing.bearing_rad);
    read_number(checks, body, "circling_radps", limits::kRate_rad_s, framing.circling_rad_s);
  }
  if (order == MissionOrder::kSetBounds) {
    FlightBounds& bounds = command.bounds;
    read_fence(checks, body, bounds);
    read_number(checks, body, "altitude_min_m", limits::kPosition_m, bounds.altitude_min_m);
    read_number(checks, body, "altitude_max_m", limits::kPosition_m, bounds.altitude_max_m);
  }
  if (order == MissionOrder::kSetReturnPlace)
    read_place(checks, body.value("position_m", Body()), "position_m", command.return_place_enu_m);
  return checks.result(command);
}

}  // namespace foretrack::station
