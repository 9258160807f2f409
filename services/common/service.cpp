// SPDX-License-Identifier: Apache-2.0
#include "services/common/service.hpp"

#include <spdlog/spdlog.h>

namespace foretrack {
namespace {

constexpr double kHealthPeriod_s = 1.0;

Parameters::Parameter yes_or_no(const char* name, const char* description,
                                const std::function<bool()>& get) {
  using namespace rcl_interfaces::msg::ParameterValue_Constants;
  Parameters::Parameter parameter;
  parameter.descriptor.name(name);
  parameter.descriptor.type(PARAMETER_BOOL);
  parameter.descriptor.description(description);
  parameter.get = [get] {
    Parameters::Value value;
    value.type(PARAMETER_BOOL);
    value.bool_value(get());
    return value;
  };
  return parameter;
}

// What ROS 2's tools expect of every node, and the level of the log, which may change in flight.
void add_own(Parameters& parameters, bool use_sim_time) {
  auto sim = yes_or_no("use_sim_time", "the time comes from the clock topic",
                       [use_sim_time] { return use_sim_time; });
  sim.descriptor.read_only(true);
  sim.descriptor.additional_constraints("an option of the service (--use-sim-time)");
  parameters.add(std::move(sim));
  auto debug = yes_or_no("debug_log", "log lines of the level debug are written, too",
                         [] { return spdlog::default_logger()->level() <= spdlog::level::debug; });
  debug.set = [](const Parameters::Value& value) {
    spdlog::default_logger()->set_level(value.bool_value() ? spdlog::level::debug
                                                           : spdlog::level::info);
  };
  parameters.add(std::move(debug));
}

}  // namespace

NodeOptions node_options(const std::string& service, const ServiceOptions& options) {
  return {service,
          options.names,
          options.domain_id,
          options.use_sim_time,
          options.ros_distro,
          options.interface,
          options.security,
          options.peers,
          options.discovery_server};
}

Service::Service(const std::string& name, const ServiceOptions& options, Stop& stop)
    : options_(options),
      node_(node_options(name, options)),
      loop_(node_, stop),
      health_(node_),
      rosout_(node_) {
  add_own(parameters_, options.use_sim_time);
  loop_.every_wall(kHealthPeriod_s, [this] {
    health_.publish(loop_.take_stats(), false);
    rosout_.publish();
  });
}

void Service::run() {
  const auto& options = node_.options();
  // Permissions of a secured bus name topics, not services.
  if (!node_.secured()) server_.emplace(node_, parameters_);
  if (server_)
    for (const auto& server : server_->servers()) loop_.serve(*server);
  node_.announce();
  spdlog::info("{}: runs for {} in domain {}", options.service, options.names.vehicle,
               options.domain_id);
  loop_.run();
  health_.publish(loop_.take_stats(), true);
  spdlog::info("{}: stopped", options.service);
  rosout_.publish();
}

}  // namespace foretrack
