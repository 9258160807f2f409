// SPDX-License-Identifier: Apache-2.0
// foretrack order: one order to a vehicle from the terminal.
#include <fmt/format.h>

#include <chrono>
#include <cstdio>
#include <memory>
#include <stdexcept>
#include <thread>

#include "services/cli/bus_options.hpp"
#include "services/cli/commands.hpp"
#include "services/common/options.hpp"
#include "services/common/stop.hpp"
#include "services/files/config/load_bounds.hpp"
#include "services/operator/order_sender.hpp"

namespace foretrack {
namespace {

struct OrderArguments {
  NodeOptions node;
  std::string order, operator_name = "terminal", bounds_file;
  double patience_s = 10.0;
};

int run_order(OrderArguments arguments) {
  const MissionOrder what = *order_of(arguments.order);
  if ((what == MissionOrder::kSetBounds) == arguments.bounds_file.empty())
    throw std::invalid_argument("bounds, and they alone, come with --file");
  FlightBounds bounds;
  if (!arguments.bounds_file.empty()) bounds = load_bounds(arguments.bounds_file);
  set_up_logging("warning");
  Stop stop;
  SignalStop signals(stop);
  arguments.node.service = "order";
  Node node(arguments.node);
  OrderSender sender(node, what, arguments.operator_name, bounds);
  const double begin_s = node.clock().steady_s();
  while (!stop.requested() && !sender.is_done() &&
         node.clock().steady_s() - begin_s < arguments.patience_s) {
    sender.update();
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  const auto result = sender.result();
  const bool heard = !sender.gate_text().empty();
  fmt::print("{}: {}\n", arguments.order,
             result  ? to_string(*result)
             : heard ? "the safety gate did not answer"
                     : "nothing was heard of the safety gate");
  const bool taken =
      result == MissionResult::kAccepted || result == MissionResult::kAcceptedUnwritten;
  return taken ? 0 : 1;
}

}  // namespace

std::function<int()> prepare_order(CLI::App& app) {
  auto arguments = std::make_shared<OrderArguments>();
  add_bus_options(app, arguments->node);
  app.add_option("order", arguments->order,
                 "start, hold, resume, return, land, stop, take_off or bounds")
      ->required()
      ->check([](const std::string& name) {
        return order_of(name) ? std::string() : "there is no order '" + name + "'";
      });
  app.add_option("--file", arguments->bounds_file,
                 "Of bounds: fence_m, altitude_min_m, altitude_max_m")
      ->check(CLI::ExistingFile);
  app.add_option("--operator", arguments->operator_name, "Who gives it")->capture_default_str();
  app.add_option("--for", arguments->patience_s, "Wait so many seconds for the answer")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  return [arguments] { return run_order(*arguments); };
}

}  // namespace foretrack
