// SPDX-License-Identifier: Apache-2.0
#include "services/onboard/onboard.hpp"

#include <array>
#include <exception>
#include <mutex>
#include <string_view>
#include <thread>
#include <vector>

#include "services/onboard/fleet/fleet_service.hpp"
#include "services/onboard/mapping/mapping_service.hpp"
#include "services/onboard/perception/perception_service.hpp"
#include "services/onboard/planning/planning_service.hpp"
#include "services/onboard/prediction/prediction_service.hpp"
#include "services/onboard/safety_gate/safety_gate_service.hpp"

namespace foretrack {
namespace {

using Options = ServiceOptions;
constexpr std::array<OnboardService, 6> kServices = {{
    {"perception", "camera observations to the target's state", "perception",
     [](const Options& o, const TrackerParams& p, Stop& s) {
       run_perception(o, p.perception, p.bodies, p.choice, p.ground_stream, s);
     }},
    {"mapping", "depth images to the map around the vehicle", "mapping",
     [](const Options& o, const TrackerParams& p, Stop& s) { run_mapping(o, p.mapping, s); }},
    {"prediction", "the target's state to intentions and predicted paths", "prediction",
     [](const Options& o, const TrackerParams& p, Stop& s) { run_prediction(o, p.prediction, s); }},
    {"fleet", "what other vehicles tell to this one's part among them", "fleet",
     [](const Options& o, const TrackerParams& p, Stop& s) {
       run_fleet(o, p.fleet, p.planning, s);
     }},
    {"planning", "predictions and map to a checked trajectory", "planning",
     [](const Options& o, const TrackerParams& p, Stop& s) {
       run_planning(o, p.planning, p.fleet, s);
     }},
    {"safety_gate", "trajectories and orders to setpoints", "safety",
     [](const Options& o, const TrackerParams& p, Stop& s) { run_safety_gate(o, p.safety, s); }},
}};

}  // namespace

std::span<const OnboardService> onboard_services() {
  return kServices;
}

void run_stages(const ServiceOptions& options, const TrackerParams& params, const StageChoice& with,
                Stop& stop) {
  std::mutex mutex;
  std::exception_ptr failure;
  std::vector<std::jthread> threads;
  for (const OnboardService& service : kServices) {
    const std::string_view name = service.name;
    if (name == "safety_gate" || (!with.mapping && name == "mapping") ||
        (!with.fleet && name == "fleet"))
      continue;
    threads.emplace_back([&, run = service.run] {
      try {
        run(options, params, stop);
      } catch (...) {
        const std::lock_guard lock(mutex);
        if (!failure) failure = std::current_exception();
        stop.request();
      }
    });
  }
  for (auto& thread : threads) thread.join();
  if (failure) std::rethrow_exception(failure);
}

}  // namespace foretrack
