// SPDX-License-Identifier: Apache-2.0
// CPU time of one replan, stage by stage, and what the planning is worth, in closed loop with a
// target that makes sharp turns in dense worlds. Usage: plan_bench [--json] [--replans N] [--seeds
// N]
#include <algorithm>
#include <cstdio>
#include <cstring>
#include <map>
#include <string>

#include "core/prediction/predict.hpp"
#include "services/common/time_now.hpp"
#include "tests/core/planning/plan_loop.hpp"

using namespace foretrack;

namespace {

struct Case {
  const char* name;
  WorldKind kind;
  int count;
  int others = 0;  // people who walk around the target
};
constexpr Case kCases[] = {
    {"boxes_60", WorldKind::kBoxes, 60},   {"boxes_90", WorldKind::kBoxes, 90},
    {"boxes_120", WorldKind::kBoxes, 120}, {"cylinders_120", WorldKind::kCylinders, 120},
    {"walls_100", WorldKind::kWalls, 100}, {"blocks", WorldKind::kBlocks, 0},
    {"crowd_8", WorldKind::kBoxes, 60, 8},
};

struct Options {
  bool json = false;
  PlanningParams params;
  int replans = 1000;
  int seeds = 1;
  double speed_m_s = 1.5;
};

using Samples = std::vector<double>;
struct Outcome {
  std::map<std::string, Samples> stages_ms;
  Samples total_ms;
  std::map<std::string, int> reasons;  // of replans that gave no fresh plan
  int replans = 0, failures = 0;
  int hidden = 0, near = 0, far = 0, out_of_view = 0, ticks = 0, turns = 0;
  double min_clearance_m = 1e9;
};

double quantile(Samples v, double q) {
  if (v.empty()) return 0.0;
  std::sort(v.begin(), v.end());
  return v[std::min(v.size() - 1, static_cast<std::size_t>(q * static_cast<double>(v.size())))];
}

void measure_view(const World& world, const VehicleState& vehicle, const TargetState& target,
                  Outcome& out) {
  ++out.ticks;
  const double distance_m = distance_xy(vehicle.position_enu_m, target.position_enu_m);
  out.hidden += !line_of_sight(world, vehicle.position_enu_m, target.position_enu_m);
  out.near += distance_m < 1.0;
  out.far += distance_m > 3.0;
  const Vec3 offset = target.position_enu_m - vehicle.position_enu_m;
  const double off_rad = wrap_angle(yaw_of(Vec2(offset.head<2>())) - vehicle.yaw_rad());
  out.out_of_view += std::abs(off_rad) > rad(45.0);
  out.min_clearance_m = std::min(out.min_clearance_m, clearance_m(world, vehicle.position_enu_m));
}

void record(const PlanResult& result, double predict_ms, double total_ms, Outcome& out) {
  for (int i = 0; i < kPlanStageCount; ++i)
    out.stages_ms[std::string(kPlanStageNames[i])].push_back(result.diagnostics.stage_ms[i]);
  out.stages_ms["prediction"].push_back(predict_ms);
  out.total_ms.push_back(total_ms);
  ++out.replans;
  if (result.trajectory.status == PlanStatus::kFresh) return;
  ++out.failures;
  ++out.reasons[std::string(to_string(result.trajectory.status)) + ": " +
                std::string(to_string(result.trajectory.reason))];
}

// They circle the target at 2 to 5.5 m, to the left and to the right, at 1 m/s.
MovingBodies crowd(int count, const TargetState& target, double now_s) {
  MovingBodies bodies;
  bodies.stamp_s = now_s;
  for (int i = 0; i < count; ++i) {
    const double radius_m = 2.0 + 0.5 * i, turn = i % 2 == 0 ? 1.0 : -1.0;
    const Vec2 out = direction_of(2.4 * i + turn * now_s / radius_m);
    MovingBody body;
    body.id = static_cast<std::uint32_t>(i + 1);
    body.kind = BodyKind::kPerson;
    body.stamp_s = now_s;
    body.position_enu_m << target.position_enu_m.head<2>() + radius_m * out, 0.0;
    body.velocity_enu_m_s << turn * Vec2(-out.y(), out.x()), 0.0;
    bodies.add(body);
  }
  return bodies;
}

void run(const Case& c, const Options& options, std::uint64_t seed, Outcome& out) {
  const std::vector<Vec2> middle = {{0.0, 0.0}, {-2.5, 0.0}};
  const World world = generate_world({c.kind, c.count, seed}, Vec3(-20.0, -20.0, 0.0),
                                     Vec3(20.0, 20.0, 5.0), middle);
  const GridMap map = known_map(world, 0.15);
  testing::Walker walker(world, Vec2::Zero(), options.speed_m_s, seed + 17);
  PlanningState planning;
  planning.clock_s = cpu_s;
  PredictionState prediction;
  const PredictionParams prediction_params;
  VehicleState vehicle = testing::hovering(Vec3(-2.0, 0.0, 1.5), 0.0, 0.0);
  constexpr double kTick_s = 0.02;
  constexpr int kTicksPerPlan = 5;
  for (int tick = 0; tick < options.replans * kTicksPerPlan; ++tick) {
    const double now_s = kTick_s * tick;
    const TargetState target = walker.state(now_s);
    const PlannedTrajectory& flown = planning.results[planning.flown].trajectory;
    if (!flown.pieces.empty() && now_s >= flown.start_s)
      vehicle = testing::state_on(flown, now_s);
    else
      vehicle.stamp_s = now_s;
    measure_view(world, vehicle, target, out);
    if (tick % kTicksPerPlan == 0) {
      const MovingBodies others = crowd(c.others, target, now_s);
      const double start_s = cpu_s();
      const PredictionResult& predicted = predict(prediction, target, map, prediction_params);
      const double predicted_s = cpu_s();
      const PlanInput input{.now_s = now_s,
                            .vehicle = vehicle,
                            .target = target,
                            .intention = &predicted.intention,
                            .prediction = &predicted.prediction,
                            .map = &map,
                            .bodies = &others};
      const PlanResult& result = plan(planning, input, options.params);
      const double end_s = cpu_s();
      record(result, 1e3 * (predicted_s - start_s), 1e3 * (end_s - start_s), out);
    }
    walker.advance(kTick_s);
  }
  out.turns += walker.turns();
}

std::string numbers(const Samples& v) {
  char text[160];
  std::snprintf(text, sizeof text,
                "{\"median\": %.4f, \"p95\": %.4f, \"p99\": %.4f, \"max\": %.4f}", quantile(v, 0.5),
                quantile(v, 0.95), quantile(v, 0.99), quantile(v, 1.0));
  return text;
}

void print_json(const char* name, const Outcome& out, bool last) {
  std::printf("  {\"name\": \"%s\", \"replans\": %d, \"failures\": %d, \"stages\": {", name,
              out.replans, out.failures);
  const char* separator = "";
  for (const auto& [stage, samples] : out.stages_ms) {
    std::printf("%s\"%s\": %s", separator, stage.c_str(), numbers(samples).c_str());
    separator = ", ";
  }
  const double ticks = std::max(out.ticks, 1);
  std::printf(
      "}, \"total\": %s, \"hidden\": %.4f, \"out_of_view\": %.4f, \"near\": %.4f, "
      "\"far\": %.4f, \"turns\": %d, \"min_clearance_m\": %.3f}%s\n",
      numbers(out.total_ms).c_str(), out.hidden / ticks, out.out_of_view / ticks, out.near / ticks,
      out.far / ticks, out.turns, out.min_clearance_m, last ? "" : ",");
}

void print_text(const char* name, const Outcome& out) {
  std::printf("%-14s %5d replans, %d without a fresh plan\n", name, out.replans, out.failures);
  const auto row = [](const std::string& stage, const Samples& v) {
    std::printf("  %-16s median %.3f  P95 %.3f  P99 %.3f  max %.3f ms\n", stage.c_str(),
                quantile(v, 0.5), quantile(v, 0.95), quantile(v, 0.99), quantile(v, 1.0));
  };
  for (const auto& [stage, samples] : out.stages_ms) row(stage, samples);
  row("total", out.total_ms);
  const double percent = 100.0 / std::max(out.ticks, 1);
  std::printf(
      "  hidden %.2f %%, out of view %.2f %%, < 1 m %.2f %%, > 3 m %.2f %%, %d turns, "
      "least clearance %.2f m\n",
      percent * out.hidden, percent * out.out_of_view, percent * out.near, percent * out.far,
      out.turns, out.min_clearance_m);
  for (const auto& [reason, count] : out.reasons)
    std::printf("  %5d × %s\n", count, reason.c_str());
}

Options parse(int argc, char** argv) {
  Options options;
  for (int i = 1; i < argc; ++i) {
    const std::string arg = argv[i];
    const bool more = i + 1 < argc;
    if (arg == "--json") options.json = true;
    if (arg == "--set" && i + 2 < argc) {
      const std::string fault = set_param(rows(options.params), argv[i + 1], argv[i + 2]);
      if (!fault.empty()) std::fprintf(stderr, "%s\n", fault.c_str());
      i += 2;
      continue;
    }
    if (arg == "--replans" && more) options.replans = std::atoi(argv[++i]);
    if (arg == "--seeds" && more) options.seeds = std::atoi(argv[++i]);
    if (arg == "--speed" && more) options.speed_m_s = std::atof(argv[++i]);
  }
  return options;
}

}  // namespace

int main(int argc, char** argv) {
  const Options options = parse(argc, argv);
  if (options.json) std::printf("{\"worlds\": [\n");
  for (const Case& c : kCases) {
    Outcome outcome;
    for (int seed = 1; seed <= options.seeds; ++seed) run(c, options, seed, outcome);
    if (options.json)
      print_json(c.name, outcome, &c == &kCases[std::size(kCases) - 1]);
    else
      print_text(c.name, outcome);
  }
  if (options.json) std::printf("]}\n");
}
