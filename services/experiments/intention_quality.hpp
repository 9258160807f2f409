// How good the probabilities of the intentions were, over the moments of many flights.
#pragma once

#include <vector>

#include "services/experiments/run_record.hpp"

namespace foretrack {

struct IntentionQuality {
  struct Bin {
    double probability = 0.0, frequency = 0.0;  // means
    int count = 0;
  };
  int windows = 0;
  double brier = 0.0, base_brier = 0.0;  // base: of always saying the base rates
  double log_loss = 0.0, base_log_loss = 0.0;
  double ece = 0.0;  // of the most probable intention, 15 bins of equal mass
  std::vector<Bin> bins;
  int turns = 0, foreseen = 0;
  double lead_time_mean_s = 0.0;
  double false_alarms_per_min = 0.0;

  double brier_skill() const { return base_brier > 0.0 ? 1.0 - brier / base_brier : 0.0; }
};

IntentionQuality intention_quality(const std::vector<const RunRecord*>& records);

}  // namespace foretrack
