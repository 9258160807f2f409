// SPDX-License-Identifier: Apache-2.0
// foretrack order: one order to a vehicle from the terminal.
#include <fmt/format.h>

#include <charconv>
#include <chrono>
#include <cstdio>
#include <map>
#include <memory>
#include <stdexcept>
#include <thread>
#include <vector>

#include "core/common/geometry.hpp"
#include "services/cli/bus_options.hpp"
#include "services/cli/commands.hpp"
#include "services/common/options.hpp"
#include "services/common/stop.hpp"
#include "services/convert/checks.hpp"
#include "services/convert/order_name.hpp"
#include "services/files/config/load_bounds.hpp"
#include "services/operator/find_nearest.hpp"
#include "services/operator/order_sender.hpp"

namespace foretrack {
namespace {

struct OrderArguments {
  NodeOptions node;
  std::string order, whom, operator_name = "terminal", bounds_file, side;
  Framing framing;
  std::vector<double> place_enu_m;
  double patience_s = 10.0;
};

const std::map<std::string, double> kSides = {{"ahead", 0.0},
                                              {"left", 0.5 * kPi},
                                              {"behind", kPi},
                                              {"right", -0.5 * kPi},
                                              {"free", Framing::kFree}};

// Of a number in digits or `nobody`; `nearest` is found out later.
std::uint32_t person_of(const std::string& whom) {
  if (whom == "nobody" || whom == "nearest") return 0;
  std::uint32_t id = 0;
  const char* end = whom.data() + whom.size();
  if (std::from_chars(whom.data(), end, id).ptr != end || id == 0)
    throw std::invalid_argument("follow whom? A number of bodies, nobody or nearest");
  return id;
}

MissionCommand command_of(const OrderArguments& arguments) {
  MissionCommand command;
  command.order = *order_of(arguments.order);
  command.operator_name = arguments.operator_name;
  if ((command.order == MissionOrder::kSetBounds) == arguments.bounds_file.empty())
    throw std::invalid_argument("bounds, and they alone, come with --file");
  if (!arguments.bounds_file.empty()) command.bounds = load_bounds(arguments.bounds_file);
  if ((command.order == MissionOrder::kFollow) == arguments.whom.empty())
    throw std::invalid_argument("follow, and it alone, is told whom: a number, nobody or nearest");
  if (!arguments.whom.empty()) command.person_id = person_of(arguments.whom);
  command.framing = arguments.framing;
  if (!arguments.side.empty()) command.framing.bearing_rad = kSides.at(arguments.side);
  if (command.order != MissionOrder::kSetFraming && !command.framing.is_free())
    throw std::invalid_argument("--distance, --height, --bearing, --circling are of framing");
  if ((command.order == MissionOrder::kSetReturnPlace) == arguments.place_enu_m.empty())
    throw std::invalid_argument("return_place, and it alone, comes with --place X Y");
  if (!arguments.place_enu_m.empty())
    command.return_place_enu_m = {arguments.place_enu_m[0], arguments.place_enu_m[1]};
  return command;
}

int tell(const OrderArguments& arguments, std::string_view what, bool taken) {
  fmt::print("{}: {}\n", arguments.order, what);
  return taken ? 0 : 1;
}

int run_order(OrderArguments arguments) {
  MissionCommand command = command_of(arguments);
  set_up_logging("warning");
  Stop stop;
  SignalStop signals(stop);
  arguments.node.service = "order";
  Node node(arguments.node);
  const double end_s = node.clock().steady_s() + arguments.patience_s;
  const auto waits = [&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    return !stop.requested() && node.clock().steady_s() < end_s;
  };
  if (arguments.whom == "nearest") {
    FindNearest nearest(node);
    while (!nearest.person_id() && waits()) nearest.update();
    if (!nearest.person_id()) return tell(arguments, "nobody is seen", false);
    command.person_id = *nearest.person_id();
  }
  OrderSender sender(node, command);
  do sender.update();
  while (!sender.is_done() && waits());
  if (const auto result = sender.result())
    return tell(arguments, to_string(*result), is_accepted(*result));
  const bool heard = !sender.gate_text().empty();
  return tell(arguments,
              heard ? "the safety gate did not answer" : "nothing was heard of the safety gate",
              false);
}

void add_framing_options(CLI::App& app, OrderArguments& arguments) {
  Framing& framing = arguments.framing;
  app.add_option("--distance", framing.distance_m, "Of framing: from the person, in metres");
  app.add_option("--height", framing.height_m, "Of framing: above their torso, in metres");
  auto* bearing = app.add_option("--bearing", framing.bearing_rad,
                                 "Of framing: counterclockwise from where they walk, in radians");
  app.add_option("--side", arguments.side, "Of framing: ahead, left, behind, right or free")
      ->check(CLI::IsMember(kSides))
      ->excludes(bearing);
  app.add_option("--circling", framing.circling_rad_s,
                 "Of framing: go round counterclockwise, in radians a second");
}

}  // namespace

std::function<int()> prepare_order(CLI::App& app) {
  auto arguments = std::make_shared<OrderArguments>();
  add_bus_options(app, arguments->node);
  app.add_option("order", arguments->order,
                 "start, hold, resume, return, land, stop, take_off, bounds, follow, framing or "
                 "return_place")
      ->required()
      ->check([](const std::string& name) {
        return order_of(name) ? std::string() : "there is no order '" + name + "'";
      });
  app.add_option("whom", arguments->whom, "Of follow: a number of bodies, nobody or nearest");
  app.add_option("--file", arguments->bounds_file,
                 "Of bounds: fence_m, altitude_min_m, altitude_max_m")
      ->check(CLI::ExistingFile);
  add_framing_options(app, *arguments);
  app.add_option("--place", arguments->place_enu_m,
                 "Of return_place: x and y in the world frame, in metres")
      ->expected(2)
      ->check(CLI::Range(-limits::kPosition_m, limits::kPosition_m));
  app.add_option("--operator", arguments->operator_name, "Who gives it")->capture_default_str();
  app.add_option("--for", arguments->patience_s, "Wait so many seconds for the answer")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  return [arguments] { return run_order(*arguments); };
}

}  // namespace foretrack
