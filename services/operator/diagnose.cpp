// SPDX-License-Identifier: Apache-2.0
#include "services/operator/diagnose.hpp"

#include <fmt/format.h>

#include <cmath>
#include <functional>

#include "services/operator/diagnose_inputs.hpp"
#include "services/operator/words.hpp"

namespace foretrack {
namespace {

using Level = Finding::Level;
using foretrack_msgs::msg::ServiceHealth;

constexpr double kClockLimit_s = 0.3;
constexpr double kServiceSilent_s = 3.0;
constexpr double kSlowTime = 0.9;
constexpr double kMoving_mps = 0.1;

/// One link of the chain: a topic, and whose work it is.
struct Link {
  std::string_view stage;
  std::string_view topic;
  std::string_view service;  // that writes it
  double max_age_s;
  std::function<Finding(const FlightSnapshot&)> content;  // what the newest sample says
};

std::string list_of(const std::vector<std::pair<std::string, std::uint64_t>>& rejected) {
  std::string text;
  for (const auto& [reason, count] : rejected)
    text += fmt::format("{}{} × {}", text.empty() ? "" : ", ", count, reason);
  return text;
}

std::string how_to_start(std::string_view service) {
  return fmt::format("`foretrack onboard` starts every service, `foretrack {}` this one alone.",
                     service);
}

// The writer is matched and silent: what does its service say?
Finding silent_writer(const FlightSnapshot& p, const Link& link, const std::string& what) {
  const auto* service = p.service(link.service);
  if (!service) return fault(link.stage, what, how_to_start(link.service));
  const auto& health = service->health;
  std::string missing;
  for (const auto& t : health.topics())
    if (!t.writes() && t.samples() == 0)
      missing += fmt::format("{}{} ({} writers)", missing.empty() ? "" : ", ", t.topic().c_str(),
                             t.peers());
  if (!missing.empty())
    return fault(link.stage, what, fmt::format("{} waits for {}.", link.service, missing));
  return fault(link.stage, what,
               health.last_error().size() == 0
                   ? fmt::format("{} says it is {}.", link.service, service_word(health.state()))
                   : fmt::format("Its last error: {}", health.last_error().c_str()));
}

Finding silent(const FlightSnapshot& p, const Link& link, const TopicFlow& flow) {
  if (auto finding = check_writers(p, flow, link.stage)) return *finding;
  if (!p.service(link.service))
    return fault(link.stage,
                 fmt::format("{} {}: the service {} is missing.",
                             flow.writers == 0 ? "Nobody writes" : "Nothing comes on", flow.wire,
                             link.service),
                 how_to_start(link.service));
  return silent_writer(p, link,
                       fmt::format("{} runs, but no sample of {} came.", link.service, flow.wire));
}

Finding check(const FlightSnapshot& p, const Link& link) {
  const auto* flow = p.flow(link.topic);
  if (!flow) return note(link.stage, fmt::format("{} was not looked at.", link.topic));
  if (flow->samples == 0) return silent(p, link, *flow);
  if (flow->age_s > link.max_age_s && !(link.topic == "map/local" && p.map_is_static)) {
    const auto text = fmt::format("{} stopped {:.1f} s ago.", flow->wire, flow->age_s);
    if (flow->writers == 0)
      return fault(link.stage, text + " Its writer is gone.", how_to_start(link.service));
    return silent_writer(p, link, text);
  }
  if (link.content) return link.content(p);
  return fine(link.stage, fmt::format("{} comes at {:.0f} Hz", flow->wire, flow->rate_hz));
}

Finding target_content(const FlightSnapshot& p) {
  namespace c = foretrack_msgs::msg::TargetState_Constants;
  const auto status = p.target->status();
  if (status == c::STATUS_TRACKING) return fine("target", "a person is being tracked");
  if (status == c::STATUS_COASTING)
    return note("target", fmt::format("The person was last measured {:.1f} s ago; coasting.",
                                      p.target->last_measurement_age_s()));
  return fault("target",
               status == c::STATUS_NONE ? "Nobody has been seen yet."
                                        : fmt::format("The person was lost {:.1f} s ago.",
                                                      p.target->last_measurement_age_s()),
               "Is a person in the camera's view, and do the observations have landmarks?");
}

Finding prediction_content(const FlightSnapshot& p) {
  namespace c = foretrack_msgs::msg::TargetPrediction_Constants;
  const auto status = p.prediction->status();
  if (status == c::STATUS_OK || status == c::STATUS_SEARCH_EXHAUSTED)
    return fine("prediction", fmt::format("{} paths are predicted", p.prediction->paths().size()));
  return fault("prediction", status == c::STATUS_NO_TARGET
                                 ? "There is no usable target to predict."
                                 : "The person seems to stand inside an obstacle.");
}

Finding plan_content(const FlightSnapshot& p) {
  namespace c = foretrack_msgs::msg::PlannedTrajectory_Constants;
  const auto status = p.plan->status();
  const auto why = explain_plan(p.plan->reason());
  if (status == c::STATUS_FRESH) return fine("plan", "a new trajectory passed the check");
  if (status == c::STATUS_KEPT)
    return note("plan", fmt::format("The last trajectory is kept: {}.", why));
  if (status == c::STATUS_SEARCH)
    return note("plan", "The person is lost; the vehicle looks where they may have gone.");
  return fault("plan", fmt::format("There is no trajectory: {}. {}", why, p.plan->text().c_str()));
}

Finding gate_content(const FlightSnapshot& p) {
  namespace c = foretrack_msgs::msg::SafetyState_Constants;
  if (p.safety->phase() == c::PHASE_IDLE)
    return fault("gate", fmt::format("The mission is idle. {}", p.safety->text().c_str()),
                 "It starts on an order alone: `foretrack order start`, or the station's page.");
  const auto mode = p.safety->mode();
  if (mode == c::MODE_TRACK) return fine("gate", "the trajectory is flown");
  if (mode == c::MODE_HOVER && p.safety->reason() == c::REASON_PLAN_HOLDS)
    return note("gate", "The vehicle hovers because the planner asks for it.");
  return fault(
      "gate",
      fmt::format("The gate's mode is {}: {}.", mode_word(mode), explain_gate(p.safety->reason())),
      p.safety->reason() == c::REASON_MISSION
          ? "An operator's order did this; `start` makes it follow again."
          : "");
}

Finding autopilot(const FlightSnapshot& p) {
  if (!p.safety) return note("autopilot", "Its state is known from the gate alone.");
  if (!p.safety->armed())
    return fault("autopilot", "The autopilot is not armed.",
                 "Arm it, or look at its pre-flight checks.");
  if (!p.safety->offboard())
    return fault("autopilot", "The autopilot is not in offboard mode, so it ignores us.",
                 "Switch to offboard; it needs our heartbeat for a second first.");
  return fine("autopilot", "armed and in offboard mode");
}

Finding movement(const FlightSnapshot& p) {
  const double speed = speed_mps(p);
  if (speed < 0.0) return note("vehicle", "Its speed is not known.");
  if (speed > kMoving_mps) return fine("vehicle", fmt::format("moves at {:.1f} m/s", speed));
  return note("vehicle", fmt::format("It stands still, {:.1f} m from the person.", distance_m(p)));
}

const std::vector<Link>& chain() {
  static const std::vector<Link> kChain = {
      {"observation", "target/observation", "perception", 1.0, nullptr},
      {"target", "target/state", "perception", 0.5, target_content},
      {"map", "map/local", "mapping", 2.0, nullptr},
      {"prediction", "target/intention", "prediction", 1.0, nullptr},
      {"prediction", "target/prediction", "prediction", 1.0, prediction_content},
      {"plan", "plan/trajectory", "planning", 0.5, plan_content},
      {"gate", "safety/state", "safety_gate", 0.5, gate_content}};
  return kChain;
}

// Without anybody on the domain, nine faults would say the same.
bool nobody_is_there(const FlightSnapshot& p) {
  if (!p.services.empty()) return false;
  for (const auto& f : p.flows)
    if (f.writers > 0 || f.samples > 0 || f.incompatible_qos > 0) return false;
  return p.foreign.empty();
}

void check_service(const ServiceReport& report, std::vector<Finding>& findings) {
  const auto& health = report.health;
  if (report.age_s > kServiceSilent_s)
    findings.push_back(fault("set-up", fmt::format("{} has said nothing for {:.0f} s.",
                                                   health.service().c_str(), report.age_s)));
  if (std::abs(report.clock_ahead_s) > kClockLimit_s)
    findings.push_back(fault("set-up",
                             fmt::format("The clock of {} is {:+.1f} s off ours.",
                                         health.service().c_str(), report.clock_ahead_s),
                             "Synchronise the clocks (chrony), or give all the same clock."));
  for (const auto& t : health.topics()) {
    std::vector<std::pair<std::string, std::uint64_t>> rejected;
    for (const auto& r : t.rejected()) rejected.emplace_back(r.reason().c_str(), r.samples());
    if (!rejected.empty())
      findings.push_back(
          note("set-up", fmt::format("{} rejected samples of {}: {}.", health.service().c_str(),
                                     t.topic().c_str(), list_of(rejected))));
  }
}

// What they say of themselves once a second bears their clock; on its way it grows older.
Finding clocks(const FlightSnapshot& p) {
  double worst_s = 0.0;
  for (const auto& service : p.services)
    if (std::abs(service.clock_ahead_s) > std::abs(worst_s)) worst_s = service.clock_ahead_s;
  return fine("set-up", fmt::format("the services' clocks and this one differ by {:+.3f} s at most",
                                    worst_s));
}

void check_versions(const FlightSnapshot& p, std::vector<Finding>& findings) {
  for (const auto& sentence : p.other_versions)
    findings.push_back(fault("set-up", sentence + ": it is misread.",
                             "Install the same version of foretrack, or of the messages, on all."));
}

}  // namespace

std::vector<Finding> diagnose(const FlightSnapshot& p) {
  if (nobody_is_there(p))
    return {fault(
        "set-up",
        fmt::format("No process of vehicle '{}' is heard on DDS domain {}.", p.vehicle, p.domain),
        p.other_vehicles.empty()
            ? (p.this_machine_only
                   ? "Is `foretrack onboard` running, with the same --domain? Only this machine is "
                     "heard; --interface NAME, on both sides, hears others."
                   : "Is `foretrack onboard` running, with the same --domain, on this network?")
            : fmt::format("Others are there: {}. Name one with --vehicle.",
                          fmt::join(p.other_vehicles, ", ")))};
  std::vector<Finding> findings;
  if (p.time_rate >= 0.0 && p.time_rate < kSlowTime)
    findings.push_back(
        note("set-up", fmt::format("Simulated time runs at {:.2f} of real time.", p.time_rate),
             "This machine is too busy to fly in real time, unless --speed asked for it."));
  if (p.this_machine_only)
    findings.push_back(note("set-up", "Only this machine is heard and hears us.",
                            "Others: --interface NAME, ADDRESS or any, on both sides."));
  if (!p.unsecured.empty())
    findings.push_back(note("set-up", p.unsecured + '.', "SECURITY.md says what helps."));
  check_versions(p, findings);
  if (p.clocks > 1)
    findings.push_back(fault("set-up",
                             fmt::format("{} simulators write one clock, which jumps.", p.clocks),
                             "Give each a --clock-topic of its own, and its services the same."));
  for (const auto& service : p.services) check_service(service, findings);
  if (!p.services.empty()) findings.push_back(clocks(p));
  const auto* map = p.flow("map/local");
  const bool map_comes = map && map->samples > 0 && (p.map_is_static || map->age_s < 2.0);
  for (auto& finding : check_inputs(p, map_comes)) findings.push_back(std::move(finding));
  for (const auto& link : chain()) findings.push_back(check(p, link));
  findings.push_back(autopilot(p));
  findings.push_back(movement(p));
  return findings;
}

const Finding* first_cause(const std::vector<Finding>& findings) {
  for (const auto& f : findings)
    if (f.level == Level::kFault) return &f;
  return nullptr;
}

std::string to_text(const std::vector<Finding>& findings) {
  std::string text;
  for (const auto& f : findings) {
    const char* mark = f.level == Level::kFine ? "ok  " : f.level == Level::kNote ? "note" : "BAD ";
    text += fmt::format("{}  {:<10}  {}\n", mark, f.stage, f.text);
    if (!f.advice.empty()) text += fmt::format("{:18}{}\n", "", f.advice);
  }
  if (const auto* cause = first_cause(findings))
    text += fmt::format("\nFirst cause: {}\n", cause->text);
  else
    text += "\nAll is well.\n";
  return text;
}

}  // namespace foretrack
