// SPDX-License-Identifier: Apache-2.0
#include "services/operator/diagnose_inputs.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

namespace foretrack {
namespace {

using Level = Finding::Level;

constexpr double kStampLimit_s = 1.0;
constexpr std::size_t kMostCandidates = 4;

/// What somebody outside writes.
struct Input {
  std::string_view stage;
  std::string_view topic;
  std::string_view what;  // "the odometry"
  std::string_view type;  // "nav_msgs/Odometry"
  double max_age_s;
  std::string_view advice;  // beside remapping
};

constexpr Input kOdometry = {
    "vehicle",           "odometry", "the odometry",
    "nav_msgs/Odometry", 0.5,        "--px4-odometry takes the flight controller's own estimate."};
constexpr Input kColor = {
    "camera", "camera/color/image", "the colour image", "sensor_msgs/Image", 1.0, ""};
constexpr Input kColorInfo = {"calibration",
                              "camera/color/camera_info",
                              "the colour camera's calibration",
                              "sensor_msgs/CameraInfo",
                              2.0,
                              "Calibrate the camera, and let its driver publish camera_info."};
constexpr Input kDepth = {
    "depth", "camera/depth/image", "the depth image", "sensor_msgs/Image", 1.0, ""};
constexpr Input kDepthInfo = {"calibration",
                              "camera/depth/camera_info",
                              "the depth camera's calibration",
                              "sensor_msgs/CameraInfo",
                              2.0,
                              ""};
constexpr Input kStatus = {"autopilot",
                           "fmu/out/vehicle_status",
                           "the flight controller's status",
                           "px4_msgs/VehicleStatus",
                           2.0,
                           "Is its DDS agent running, in this domain?"};

std::string wire_type(std::string_view type) {
  const auto slash = type.find('/');
  return fmt::format("{}::msg::dds_::{}_", type.substr(0, slash), type.substr(slash + 1));
}

// Topics of the same type under other names, and how one of them is taken.
std::string candidates(const FlightSnapshot& p, const Input& input) {
  std::vector<std::string> topics;
  for (const auto& [topic, type] : p.published)
    if (type == wire_type(input.type) && topic.starts_with("rt/") && !p.is_ours(topic))
      topics.push_back(topic.substr(3));
  std::sort(topics.begin(), topics.end());
  if (topics.empty()) return "";
  if (topics.size() > kMostCandidates) topics.resize(kMostCandidates);
  return fmt::format("Of this type are: {}. --remap {}:={} takes it.", fmt::join(topics, ", "),
                     input.topic, topics.front());
}

std::string advice_of(const FlightSnapshot& p, const Input& input) {
  if (p.simulated) return "The simulator writes it: `foretrack up` starts all.";
  std::string advice = candidates(p, input);
  if (advice.empty())
    advice = fmt::format("Its driver must publish {} there; --remap {}:=TOPIC takes another topic.",
                         input.type, input.topic);
  if (!input.advice.empty()) advice += fmt::format(" {}", input.advice);
  return advice;
}

Finding check(const FlightSnapshot& p, const Input& input) {
  const auto* flow = p.flow(input.topic);
  if (!flow) return note(input.stage, fmt::format("{} was not looked at.", input.topic));
  if (flow->samples == 0) {
    if (auto finding = check_writers(p, *flow, input.stage)) return *finding;
    if (flow->writers > 0)
      return fault(input.stage,
                   fmt::format("{} has a writer, but nothing comes: {}.", flow->wire, input.what),
                   "Is its driver stuck, or its sensor unplugged?");
    return fault(input.stage, fmt::format("Nobody writes {}: {}.", flow->wire, input.what),
                 advice_of(p, input));
  }
  if (flow->age_s > input.max_age_s)
    return fault(input.stage,
                 fmt::format("{} stopped {:.1f} s ago.{}", flow->wire, flow->age_s,
                             flow->writers == 0 ? " Its writer is gone." : ""),
                 advice_of(p, input));
  if (!flow->refusal.empty())
    return note(input.stage, fmt::format("{} comes at {:.0f} Hz; some samples are refused: {}.",
                                         flow->wire, flow->rate_hz, flow->refusal));
  return fine(input.stage, fmt::format("{} comes at {:.0f} Hz", flow->wire, flow->rate_hz));
}

bool comes(const FlightSnapshot& p, std::string_view topic) {
  const auto* flow = p.flow(topic);
  return flow && flow->samples > 0;
}

// What hinders a service now, in its own words; empty: nothing.
std::string trouble_of(const ServiceReport& report) {
  using foretrack_msgs::msg::ServiceHealth_Constants::STATE_DEGRADED;
  return report.health.state() == STATE_DEGRADED ? report.health.last_error().c_str() : "";
}

// A service alone knows the frames of its images.
std::optional<Finding> check_mount(const FlightSnapshot& p, std::string_view service) {
  const auto* report = p.service(service);
  if (!report) return std::nullopt;
  const std::string words = trouble_of(*report);
  if (words.empty()) return fine("mount", fmt::format("{} knows where its camera sits", service));
  if (words.find("where the camera '") == std::string::npos) return std::nullopt;
  return fault("mount", fmt::format("{}: {}.", service, words),
               "Publish the transforms from the body to the image's frame on /tf_static, or give "
               "--color-mount and --depth-mount; --base-frame names another body.");
}

Finding detection(const FlightSnapshot& p) {
  const auto* report = p.service("perception");
  if (!report) return note("detection", "perception does not run.");
  const std::string words = trouble_of(*report);
  if (words.find("./run models") != std::string::npos)
    return fault("detection", fmt::format("The networks cannot be loaded: {}", words),
                 "`./run models` fetches them.");
  if (p.nobody_in_images)
    return note("detection", "Images are looked at, and nobody is found in them.",
                "Is a person in view, in good light, and is the image upright?");
  return fine("detection", "people are found in the images");
}

void check_color(const FlightSnapshot& p, std::vector<Finding>& findings) {
  if (comes(p, kColor.topic) || comes(p, "camera/color/image/compressed")) {
    findings.push_back(comes(p, kColor.topic) ? check(p, kColor)
                                              : fine("camera", "compressed colour images come"));
    findings.push_back(check(p, kColorInfo));
    if (auto mount = check_mount(p, "perception")) findings.push_back(*mount);
    findings.push_back(detection(p));
    return;
  }
  Finding color = check(p, kColor);
  // A camera front end of somebody else, or the simulator, says what is seen.
  if (comes(p, "target/observation") && color.level == Level::kFault)
    color = note("camera", "No colour images come; observations come from elsewhere.");
  findings.push_back(color);
}

void check_depth(const FlightSnapshot& p, bool map_comes, std::vector<Finding>& findings) {
  Finding depth = check(p, kDepth);
  if (map_comes && !comes(p, kDepth.topic) && depth.level == Level::kFault)
    depth.level = Level::kNote;
  const bool images = depth.level != Level::kFault && comes(p, kDepth.topic);
  findings.push_back(std::move(depth));
  if (!images) return;
  findings.push_back(check(p, kDepthInfo));
  if (auto mount = check_mount(p, "mapping")) findings.push_back(*mount);
}

std::optional<Finding> other_release(const FlightSnapshot& p) {
  if (p.px4_spoken.empty() || p.px4_spoken == p.px4_release) return std::nullopt;
  return fault("autopilot",
               fmt::format("The flight controller speaks as PX4 {} does; {} is expected.",
                           p.px4_spoken, p.px4_release),
               fmt::format("Give everything --px4 {}.", p.px4_spoken));
}

// Of a vehicle of several: rt/px4_2/fmu/out/vehicle_status.
std::string other_namespace(const FlightSnapshot& p) {
  for (const auto& [topic, type] : p.published) {
    const auto at = topic.find("/fmu/out/vehicle_status");
    if (at != std::string::npos && at > 3 && topic.starts_with("rt/"))
      return topic.substr(3, at - 3);
  }
  return "";
}

Finding check_status(const FlightSnapshot& p) {
  if (auto finding = other_release(p)) return *finding;
  Finding finding = check(p, kStatus);
  const auto other = other_namespace(p);
  if (finding.level == Level::kFault && !comes(p, kStatus.topic) && !other.empty())
    finding.advice = fmt::format("One is there under another name: --px4-namespace {}.", other);
  if (finding.level != Level::kFine || std::abs(p.px4_ahead_s) < kStampLimit_s) return finding;
  return fault(
      "autopilot",
      fmt::format("The flight controller's stamps are not in this machine's time: {:+.1f} s.",
                  p.px4_ahead_s),
      "Set its parameter UXRCE_DDS_SYNCT to 1 and start its DDS agent anew.");
}

}  // namespace

std::optional<Finding> check_writers(const FlightSnapshot& p, const TopicFlow& flow,
                                     std::string_view stage) {
  if (flow.incompatible_qos > 0 && flow.writers == 0)
    return fault(stage,
                 fmt::format("A writer of {} is there, but its quality of service does not fit "
                             "ours, so DDS keeps them apart.",
                             flow.wire),
                 "`foretrack topics` names the policy; compare it with qos/profiles.xml.");
  for (const auto& sentence : p.foreign)
    if (sentence.find(flow.wire) != std::string::npos)
      return fault(stage, "Foreign endpoint: " + sentence,
                   "Both sides must use the type from idl/, without a key.");
  if (flow.rejected.empty()) return std::nullopt;
  std::string reasons;
  for (const auto& [reason, count] : flow.rejected)
    reasons += fmt::format("{}{} × {}", reasons.empty() ? "" : ", ", count, reason);
  return fault(stage,
               fmt::format("All samples of {} were rejected: {}.", flow.wire,
                           flow.refusal.empty() ? reasons : reasons + ": " + flow.refusal),
               "The writer sends what the contract (idl/README.md) does not allow.");
}

std::vector<Finding> check_inputs(const FlightSnapshot& p, bool map_comes) {
  std::vector<Finding> findings;
  findings.push_back(check(p, kOdometry));
  check_color(p, findings);
  check_depth(p, map_comes, findings);
  if (!p.fitting_presets.empty())
    findings.push_back(note("camera",
                            fmt::format("Published are the topics of these presets: {}.",
                                        fmt::join(p.fitting_presets, ", ")),
                            "--preset NAME takes them, for everything that is started."));
  findings.push_back(check_status(p));
  return findings;
}

}  // namespace foretrack
