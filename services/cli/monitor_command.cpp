// SPDX-License-Identifier: Apache-2.0
// foretrack monitor: one vehicle, live, in the terminal.
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "services/cli/bus_options.hpp"
#include "services/cli/commands.hpp"
#include "services/common/find_px4.hpp"
#include "services/common/loop.hpp"
#include "services/common/options.hpp"
#include "services/operator/listener.hpp"
#include "services/operator/snapshot_json.hpp"
#include "services/operator/view.hpp"

namespace foretrack {
namespace {

constexpr double kTakePeriod_s = 0.05;
constexpr double kDrawPeriod_s = 0.15;
constexpr double kLinePeriod_s = 1.0;

struct MonitorArguments {
  NodeOptions node;
  bool headless = false;
  bool json = false;
  double for_s = 0.0;  // 0: until Ctrl-C
};

int run_monitor(MonitorArguments arguments) {
  const bool on_screen = is_terminal() && !arguments.headless && !arguments.json;
  Stop stop;
  SignalStop signals(stop);
  set_up_logging(on_screen ? "off" : "warning");
  arguments.node.service = "monitor";
  settle_px4_release(arguments.node, stop);
  Node node(arguments.node);
  Loop loop(node, stop);
  Listener listener(node, false);
  const double begin_s = node.clock().steady_s();
  std::unique_ptr<Screen> screen;
  if (on_screen) screen = std::make_unique<Screen>();
  ViewOptions view;
  view.colors = on_screen;
  loop.every_wall(kTakePeriod_s, [&] { listener.update(); });
  loop.every_wall(on_screen ? kDrawPeriod_s : kLinePeriod_s, [&] {
    view.elapsed_s = node.clock().steady_s() - begin_s;
    const FlightSnapshot snapshot = listener.snapshot();
    if (screen) return screen->show(draw(snapshot, view));
    const std::string line =
        arguments.json ? to_json(snapshot).dump() : status_line(snapshot, view);
    std::printf("%s\n", line.c_str());
    std::fflush(stdout);
  });
  if (arguments.for_s > 0.0)
    loop.every_wall(0.1, [&] {
      if (node.clock().steady_s() - begin_s >= arguments.for_s) stop.request();
    });
  loop.run();
  return 0;
}

}  // namespace

std::function<int()> prepare_monitor(CLI::App& app) {
  auto arguments = std::make_shared<MonitorArguments>();
  add_bus_options(app, arguments->node);
  app.add_flag("--headless", arguments->headless, "A line a second instead of a screen");
  app.add_flag("--json", arguments->json, "A JSON object a second");
  app.add_option("--for", arguments->for_s, "Stop after so many seconds")
      ->check(CLI::PositiveNumber);
  return [arguments] { return run_monitor(*arguments); };
}

}  // namespace foretrack
