// SPDX-License-Identifier: Apache-2.0
#include "services/common/find_px4.hpp"

#include <chrono>
#include <thread>

#include "services/common/px4_releases.hpp"
#include "services/common/time_now.hpp"

namespace foretrack {
namespace {

constexpr double kPatience_s = 3.0;  // of somebody who looks

}  // namespace

std::string_view px4_release_on(const Node& node) {
  std::vector<std::string> topics;
  for (const auto& endpoint : node.endpoints())
    if (endpoint.writes) topics.push_back(endpoint.topic);
  return px4_release_of(topics, node.options().names.px4_namespace);
}

std::string_view find_px4_release(NodeOptions options, double patience_s, const Stop& stop) {
  options.use_sim_time = false;
  const Node node(options);
  const double begin_s = steady_s();
  while (!stop.requested() && steady_s() - begin_s < patience_s) {
    if (const auto release = px4_release_on(node); !release.empty()) return release;
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  return {};
}

void settle_px4_release(NodeOptions& options, const Stop& stop) {
  auto& release = options.names.px4_release;
  if (release.empty()) release = find_px4_release(options, kPatience_s, stop);
}

}  // namespace foretrack
