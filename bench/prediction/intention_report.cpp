#include "bench/prediction/intention_report.hpp"

#include <algorithm>
#include <cmath>

namespace foretrack::bench {
namespace {

constexpr int kBins = 15;
constexpr int kEvery = 5;            // estimates between judged windows: 0.2 s
constexpr double kAlarm = 0.5;       // probability that counts as an announcement
constexpr double kEarliest_s = 1.0;  // an announcement is right if the turn begins within this
constexpr double kLatest_s = 0.8;    // or began this long before
constexpr double kForgiven_gap_s = 0.2;
constexpr double kNever_s = -1.0;  // lead of a turn that was not announced
constexpr double kHold_s = 0.08;   // shorter is flicker; an announcement counts from its end

double time_of(const Moment& m) {
  return m.truth_index * kTruthStep_s;
}

struct Run {
  double from_s, to_s;
};

// Times over which something was announced without a gap.
template <class ProbabilityOf>
std::vector<Run> announcements(const std::vector<Moment>& moments, ProbabilityOf&& probability_of) {
  std::vector<Run> runs;
  for (const Moment& m : moments) {
    if (!m.label || probability_of(m.p) <= kAlarm) continue;
    const double t = time_of(m);
    if (!runs.empty() && t - runs.back().to_s <= kForgiven_gap_s)
      runs.back().to_s = t;
    else
      runs.push_back({t, t});
  }
  std::erase_if(runs, [](const Run& run) { return run.to_s - run.from_s < kHold_s - 1e-9; });
  for (Run& run : runs) run.from_s += kHold_s;
  return runs;
}

double lead_s(const std::vector<Run>& runs, double onset_s) {
  for (const Run& run : runs)
    if (run.to_s >= onset_s - kForgiven_gap_s && run.from_s <= onset_s - kNever_s)
      return onset_s - run.from_s;
  return kNever_s;
}

double square(double x) {
  return x * x;
}

double median(const std::vector<double>& sorted) {
  return sorted.empty() ? 0.0 : sorted[sorted.size() / 2];
}

}  // namespace

std::vector<ReliabilityBin> reliability_bins(std::vector<std::pair<double, bool>> pairs, int bins) {
  std::sort(pairs.begin(), pairs.end());
  std::vector<ReliabilityBin> result;
  const std::size_t n = pairs.size();
  for (int b = 0; b < bins; ++b) {
    const std::size_t from = n * b / bins, to = n * (b + 1) / bins;
    ReliabilityBin bin;
    for (std::size_t i = from; i < to; ++i) {
      bin.mean_probability += pairs[i].first;
      bin.frequency += pairs[i].second ? 1.0 : 0.0;
      ++bin.count;
    }
    if (bin.count == 0) continue;
    bin.mean_probability /= bin.count;
    bin.frequency /= bin.count;
    result.push_back(bin);
  }
  return result;
}

double expected_calibration_error(const std::vector<ReliabilityBin>& bins) {
  double sum = 0.0;
  int count = 0;
  for (const auto& bin : bins) {
    sum += bin.count * std::abs(bin.mean_probability - bin.frequency);
    count += bin.count;
  }
  return count > 0 ? sum / count : 0.0;
}

void IntentionScorer::add(const std::vector<Moment>& moments,
                          const std::vector<TruthSample>& truth) {
  for (std::size_t k = 0; k < moments.size(); ++k) {
    if (!moments[k].label) continue;
    walked_s_ += kTruthStep_s * kTruthPerEstimate;
    if (k % kEvery == 0) windows_.push_back({moments[k].p, *moments[k].label});
  }
  const auto events = turn_events(truth);
  const auto any = announcements(moments, [](const Probabilities& p) { return p[1] + p[2]; });
  for (const TurnEvent& e : events) leads_any_s_.push_back(lead_s(any, e.onset * kTruthStep_s));
  for (const Intention side : {Intention::kTurnLeft, Intention::kTurnRight}) {
    const auto runs =
        announcements(moments, [&](const Probabilities& p) { return p[index_of(side)]; });
    for (const TurnEvent& e : events)
      if (e.side == side) leads_s_.push_back(lead_s(runs, e.onset * kTruthStep_s));
    for (const Run& run : runs) {
      const bool right = std::any_of(events.begin(), events.end(), [&](const TurnEvent& e) {
        const double onset_s = e.onset * kTruthStep_s;
        return e.side == side && onset_s >= run.from_s - kLatest_s &&
               onset_s <= run.to_s + kEarliest_s;
      });
      if (!right) ++false_alarms_;
    }
  }
}

IntentionReport IntentionScorer::report() const {
  IntentionReport r;
  r.windows = static_cast<int>(windows_.size());
  if (windows_.empty()) return r;
  const double n = r.windows;
  for (const Judged& w : windows_) r.base_rate[index_of(w.label)] += 1.0 / n;
  double base_brier = 0.0;
  std::vector<std::pair<double, bool>> best_pairs, turn_pairs;
  for (const Judged& w : windows_) {
    const int label = index_of(w.label);
    for (int i = 0; i < kIntentionCount; ++i) {
      r.brier += square(w.p[i] - (i == label)) / n;
      base_brier += square(r.base_rate[i] - (i == label)) / n;
    }
    r.log_loss -= std::log(std::max(1e-9, w.p[label])) / n;
    r.base_log_loss -= std::log(r.base_rate[label]) / n;
    const int best = static_cast<int>(std::max_element(w.p.begin(), w.p.end()) - w.p.begin());
    best_pairs.emplace_back(w.p[best], best == label);
    turn_pairs.emplace_back(w.p[1], label == 1);
    turn_pairs.emplace_back(w.p[2], label == 2);
  }
  r.brier_skill = base_brier > 0.0 ? 1.0 - r.brier / base_brier : 0.0;
  r.reliability = reliability_bins(std::move(best_pairs), kBins);
  r.turn_reliability = reliability_bins(std::move(turn_pairs), kBins);
  r.ece = expected_calibration_error(r.reliability);
  r.ece_turn = expected_calibration_error(r.turn_reliability);
  r.leads_s = leads_s_;
  std::sort(r.leads_s.begin(), r.leads_s.end());
  r.turns = static_cast<int>(r.leads_s.size());
  r.median_lead_s = median(r.leads_s);
  std::vector<double> any = leads_any_s_;
  std::sort(any.begin(), any.end());
  r.median_lead_any_s = median(any);
  for (const double lead : r.leads_s)
    r.foreseen_share += (lead > 0.0) / std::max(1.0, double(r.turns));
  r.walked_min = walked_s_ / 60.0;
  r.false_alarms_per_min = false_alarms_ / std::max(1e-9, r.walked_min);
  return r;
}

}  // namespace foretrack::bench
