// How good the intention probabilities are.
#pragma once

#include <vector>

#include "bench/prediction/labels.hpp"
#include "core/common/prediction.hpp"

namespace foretrack::bench {

using Probabilities = std::array<double, kIntentionCount>;

/// What was said at the time of one estimate.
struct Moment {
  int truth_index = 0;
  Probabilities p{};
  std::optional<Intention> label;
};

struct ReliabilityBin {
  double mean_probability = 0.0;
  double frequency = 0.0;
  int count = 0;
};

struct IntentionReport {
  int windows = 0;
  std::array<double, kIntentionCount> base_rate{};
  double brier = 0.0;
  double brier_skill = 0.0;  // against always saying the held-out base rates
  double log_loss = 0.0;
  double base_log_loss = 0.0;
  double ece = 0.0;                              // of the most probable intention
  double ece_turn = 0.0;                         // of both turns' probabilities
  std::vector<ReliabilityBin> reliability;       // 15 bins of equal mass
  std::vector<ReliabilityBin> turn_reliability;  // the same, of the turns
  int turns = 0;
  double foreseen_share = 0.0;     // of the turns: p > 0.5 at the onset
  double median_lead_s = 0.0;      // of p(side) > 0.5 before the onset, without a gap
  double median_lead_any_s = 0.0;  // of p(left) + p(right) > 0.5
  std::vector<double> leads_s;     // sorted
  double walked_min = 0.0;
  double false_alarms_per_min = 0.0;
};

/// Collects episodes, then reports.
class IntentionScorer {
 public:
  void add(const std::vector<Moment>& moments, const std::vector<TruthSample>& truth);
  IntentionReport report() const;

 private:
  struct Judged {
    Probabilities p;
    Intention label;
  };
  std::vector<Judged> windows_;
  std::vector<double> leads_s_, leads_any_s_;
  double walked_s_ = 0.0;
  int false_alarms_ = 0;
};

/// Bins of equal mass over (probability, came true), and their mean absolute gap.
std::vector<ReliabilityBin> reliability_bins(std::vector<std::pair<double, bool>> pairs, int bins);
double expected_calibration_error(const std::vector<ReliabilityBin>& bins);

}  // namespace foretrack::bench
