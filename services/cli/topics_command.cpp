// SPDX-License-Identifier: Apache-2.0
// foretrack topics: every topic of the contract, live.
#include <fmt/format.h>

#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "services/cli/bus_options.hpp"
#include "services/cli/commands.hpp"
#include "services/common/find_px4.hpp"
#include "services/common/loop.hpp"
#include "services/common/options.hpp"
#include "services/operator/snapshot_json.hpp"
#include "services/operator/topic_watch.hpp"
#include "services/operator/view.hpp"

namespace foretrack {
namespace {

struct TopicsArguments {
  NodeOptions node;
  bool json = false;
  double for_s = 3.0;
};

std::string table_of(const std::vector<TopicFlow>& flows,
                     const std::vector<ForeignEndpoint>& foreign) {
  std::string text =
      fmt::format("{:<44}{:>9}{:>10}{:>9}{:>9}\n", "topic", "rate", "age", "writers", "readers");
  for (const auto& f : flows) {
    if (f.writers == 0 && f.readers <= 0 && f.samples == 0 && f.incompatible_qos == 0) continue;
    const auto age = f.age_s < 0.0 ? "never" : fmt::format("{:.2f} s", f.age_s);
    text += fmt::format("{:<44}{:>6.1f} Hz{:>10}{:>9}{:>9}\n", f.wire, f.rate_hz, age, f.writers,
                        f.readers);
    if (f.incompatible_qos > 0)
      text += fmt::format("    {} writers refused: their quality of service does not fit\n",
                          f.incompatible_qos);
    for (const auto& [reason, count] : f.rejected)
      text += fmt::format("    {} samples rejected: {}\n", count, reason);
  }
  for (const auto& e : foreign)
    text += fmt::format("foreign {} on {}: {}\n", e.writes ? "writer" : "reader", e.topic, e.why);
  return text;
}

int run_topics(TopicsArguments arguments) {
  set_up_logging("warning");
  Stop stop;
  SignalStop signals(stop);
  arguments.node.service = "topics";
  settle_px4_release(arguments.node, stop);
  Node node(arguments.node);
  Loop loop(node, stop);
  TopicWatch watch(node);
  const double begin_s = node.clock().steady_s();
  loop.every_wall(0.05, [&] {
    watch.update();
    if (node.clock().steady_s() - begin_s >= arguments.for_s) stop.request();
  });
  loop.run();
  const auto flows = watch.flows();
  if (!arguments.json) {
    std::printf("%s", table_of(flows, node.foreign_endpoints()).c_str());
    return 0;
  }
  auto json = nlohmann::ordered_json::array();
  for (const auto& flow : flows) json.push_back(to_json(flow));
  std::printf("%s\n", json.dump(2).c_str());
  return 0;
}

}  // namespace

std::function<int()> prepare_topics(CLI::App& app) {
  auto arguments = std::make_shared<TopicsArguments>();
  add_bus_options(app, arguments->node);
  app.add_option("--for", arguments->for_s, "Listen for so many seconds")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_flag("--json", arguments->json, "For programs");
  return [arguments] { return run_topics(*arguments); };
}

}  // namespace foretrack
