// SPDX-License-Identifier: Apache-2.0
// How long each stage took, if the caller gives a clock; core itself reads none.
#pragma once

#include <array>
#include <string_view>

namespace foretrack {

/// The stages of a replan that are timed.
enum class PlanStage { kPath, kVisibleRegions, kCorridor, kOptimization, kCheck };
inline constexpr int kPlanStageCount = 5;
inline constexpr std::array<std::string_view, kPlanStageCount> kPlanStageNames = {
    "path", "visible_regions", "corridor", "optimization", "check"};

/// Times the stages of one replan by the caller's clock; without one, everything takes 0.
class StageClock {
 public:
  explicit StageClock(double (*clock_s)() = nullptr) : clock_s_(clock_s) { lap_s_ = now_s(); }
  /// Gives the time since the last call to the stage.
  void lap(PlanStage stage) {
    if (clock_s_ == nullptr) return;
    const double now = now_s();
    stage_ms_[static_cast<int>(stage)] += 1e3 * (now - lap_s_);
    lap_s_ = now;
  }
  const std::array<double, kPlanStageCount>& stage_ms() const { return stage_ms_; }

 private:
  double now_s() const { return clock_s_ == nullptr ? 0.0 : clock_s_(); }
  double (*clock_s_)();
  double lap_s_ = 0.0;
  std::array<double, kPlanStageCount> stage_ms_{};
};

}  // namespace foretrack
