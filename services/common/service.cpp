// SPDX-License-Identifier: Apache-2.0
#include "services/common/service.hpp"

#include <spdlog/spdlog.h>

namespace foretrack {
namespace {

constexpr double kHealthPeriod_s = 1.0;

}  // namespace

NodeOptions node_options(const std::string& service, const ServiceOptions& options) {
  const auto ros =
      options.ros_iron_or_later ? RosDistribution::kIronOrLater : RosDistribution::kHumble;
  return {service,           options.names,    options.domain_id, options.use_sim_time,    ros,
          options.interface, options.security, options.peers,     options.discovery_server};
}

Service::Service(const std::string& name, const ServiceOptions& options, Stop& stop)
    : options_(options), node_(node_options(name, options)), loop_(node_, stop), health_(node_) {
  loop_.every_wall(kHealthPeriod_s, [this] { health_.publish(loop_.take_stats(), false); });
}

void Service::run() {
  const auto& options = node_.options();
  spdlog::info("{}: runs for {} in domain {}", options.service, options.names.vehicle,
               options.domain_id);
  loop_.run();
  health_.publish(loop_.take_stats(), true);
  spdlog::info("{}: stopped", options.service);
}

}  // namespace foretrack
