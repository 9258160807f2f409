// SPDX-License-Identifier: Apache-2.0
#include "services/onboard/prediction/prediction_service.hpp"

#include "core/fleet/use_fleet.hpp"
#include "core/prediction/calibrate.hpp"
#include "services/common/time_now.hpp"
#include "services/convert/map.hpp"
#include "services/convert/prediction.hpp"
#include "services/convert/target.hpp"
#include "services/convert/visual.hpp"

namespace foretrack {
namespace {

// Found here, where all from_idl are declared.
constexpr auto convert = [](auto&& message) {
  return from_idl(std::forward<decltype(message)>(message));
};

constexpr double kDeclarePeriod_s = 0.2;

// Whoever starts prediction is to know that these are never expected.
std::string names_of(const std::vector<std::string_view>& unfitted) {
  std::string names;
  for (const std::string_view name : unfitted) names.append(names.empty() ? "" : ", ").append(name);
  return names.empty() ? "none" : names;
}

}  // namespace

PredictionService::PredictionService(Service& service, const PredictionParams& params)
    : service_(service),
      params_(params),
      map_reader_(service.node()),
      target_(service.node()),
      told_reader_(service.node()),
      intention_(service.node()),
      prediction_(service.node()),
      path_(service.node()),
      markers_(service.node()) {
  service.health().set_fact("unfitted_intentions", names_of(unfitted()));
  Loop& loop = service.loop();
  loop.on_newest(map_reader_, convert, [this](GridMap&& map) { map_ = std::move(map); });
  loop.on_newest(told_reader_, convert, [this](const TargetState& told) { told_ = told; });
  loop.on_newest(target_, convert, [this](const TargetState& target) {
    taken_s_ = service_.clock().now_s();
    predict_from(target);
  });
  loop.every(kDeclarePeriod_s, [this] { declare_if_silent(); });
}

// Without a map nothing is known to stand in the target's way.
void PredictionService::predict_from(const TargetState& own) {
  const TargetState& target = seen_by_any(own, told_, service_.clock().now_s());
  const double start_s = steady_s();
  const auto& [intention, prediction] = predict(state_, target, map_, params_);
  if (prediction.status != PredictionStatus::kNoTarget) {
    to_idl(intention, intention_.sample());
    intention_.write();
  }
  to_idl(prediction, prediction_.sample());
  prediction_.sample().compute_ms(1e3 * (steady_s() - start_s));
  prediction_.write();
  draw();
}

void PredictionService::declare_if_silent() {
  const double now_s = service_.clock().now_s();
  const bool silent = std::abs(now_s - taken_s_) > params_.target_stale_s;
  service_.health().set_degraded(silent ? "no target state" : map_.empty() ? "no map" : "");
  if (!silent) return;
  TargetState none;
  none.stamp_s = now_s;
  predict_from(none);
}

void PredictionService::draw() {
  if (!drawing_.is_due(service_.clock().now_s())) return;
  const auto& [intention, prediction] = state_.result;
  if (path_.readers() > 0) {
    to_path(prediction, path_.sample());
    path_.write();
  }
  if (markers_.readers() > 0) {
    to_markers(intention, prediction, markers_.sample());
    markers_.write();
  }
}

void run_prediction(const ServiceOptions& options, const PredictionParams& params, Stop& stop) {
  Service service("prediction", options, stop);
  service.show("prediction", params);
  PredictionService stage(service, params);
  service.run();
}

}  // namespace foretrack
