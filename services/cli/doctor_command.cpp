// SPDX-License-Identifier: Apache-2.0
// foretrack doctor: why does the vehicle not move?
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "services/cli/bus_options.hpp"
#include "services/cli/commands.hpp"
#include "services/common/find_px4.hpp"
#include "services/common/loop.hpp"
#include "services/common/options.hpp"
#include "services/operator/diagnose.hpp"
#include "services/operator/installation.hpp"
#include "services/operator/listener.hpp"

namespace foretrack {
namespace {

struct DoctorArguments {
  NodeOptions node;
  std::string params_file;
  bool json = false;
  bool camera = false;  // only what is of cameras
  double for_s = 3.0;
};

bool is_of_cameras(const Finding& finding) {
  for (const char* stage : {"camera", "calibration", "mount", "detection", "depth"})
    if (finding.stage == stage) return true;
  return false;
}

std::vector<Finding> examine(DoctorArguments arguments) {
  auto findings = check_installation(arguments.params_file);
  if (first_cause(findings)) return findings;
  Stop stop;
  SignalStop signals(stop);
  arguments.node.service = "doctor";
  settle_px4_release(arguments.node, stop);
  Node node(arguments.node);
  Loop loop(node, stop);
  Listener listener(node, true);
  const double begin_s = node.clock().steady_s();
  loop.every_wall(0.05, [&] {
    listener.update();
    if (node.clock().steady_s() - begin_s >= arguments.for_s) stop.request();
  });
  loop.run();
  for (auto& finding : diagnose(listener.snapshot())) findings.push_back(std::move(finding));
  if (arguments.camera) std::erase_if(findings, [](const Finding& f) { return !is_of_cameras(f); });
  return findings;
}

nlohmann::ordered_json json_of(const std::vector<Finding>& findings) {
  constexpr const char* kLevels[] = {"fine", "note", "fault"};
  nlohmann::ordered_json json;
  json["findings"] = nlohmann::ordered_json::array();
  for (const auto& f : findings)
    json["findings"].push_back({{"level", kLevels[static_cast<int>(f.level)]},
                                {"stage", f.stage},
                                {"text", f.text},
                                {"advice", f.advice}});
  const auto* cause = first_cause(findings);
  json["first_cause"] = cause ? nlohmann::ordered_json(cause->text) : nullptr;
  return json;
}

int run_doctor(const DoctorArguments& arguments) {
  set_up_logging("error");
  const auto findings = examine(arguments);
  std::printf("%s", arguments.json ? (json_of(findings).dump(2) + "\n").c_str()
                                   : to_text(findings).c_str());
  return first_cause(findings) ? 1 : 0;
}

}  // namespace

std::function<int()> prepare_doctor(CLI::App& app) {
  auto arguments = std::make_shared<DoctorArguments>();
  add_bus_options(app, arguments->node);
  app.add_option("--params", arguments->params_file, "Also check this parameter file");
  app.add_option("--for", arguments->for_s, "Listen for so many seconds")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_flag("--camera", arguments->camera, "Only cameras, and which preset fits them");
  app.add_flag("--json", arguments->json, "For programs");
  return [arguments] { return run_doctor(*arguments); };
}

}  // namespace foretrack
