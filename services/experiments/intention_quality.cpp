#include "services/experiments/intention_quality.hpp"

#include <algorithm>
#include <cmath>

namespace foretrack {
namespace {

constexpr int kBins = 15;
constexpr double kLeastProbability = 1e-9;

void score(const std::vector<const IntentionWindow*>& windows, IntentionQuality& q) {
  const double n = static_cast<double>(windows.size());
  std::array<double, kIntentionCount> base{};
  for (const auto* w : windows) base[w->label] += 1.0 / n;
  for (const auto* w : windows) {
    for (int k = 0; k < kIntentionCount; ++k) {
      const double truth = w->label == k ? 1.0 : 0.0;
      q.brier += (w->p[k] - truth) * (w->p[k] - truth) / n;
      q.base_brier += (base[k] - truth) * (base[k] - truth) / n;
    }
    q.log_loss -= std::log(std::max<double>(w->p[w->label], kLeastProbability)) / n;
    q.base_log_loss -= std::log(base[w->label]) / n;
  }
}

void fill_bins(const std::vector<const IntentionWindow*>& windows, IntentionQuality& q) {
  std::vector<std::pair<double, bool>> pairs;
  for (const auto* w : windows) {
    const auto best = std::max_element(w->p.begin(), w->p.end()) - w->p.begin();
    pairs.emplace_back(w->p[best], best == w->label);
  }
  // Moments of equal probability stay in their order: sorted by outcome they would fill whole bins.
  std::stable_sort(pairs.begin(), pairs.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  const std::size_t n = pairs.size();
  for (int b = 0; b < kBins; ++b) {
    IntentionQuality::Bin bin;
    for (std::size_t i = n * b / kBins; i < n * (b + 1) / kBins; ++i) {
      bin.probability += pairs[i].first;
      bin.frequency += pairs[i].second ? 1.0 : 0.0;
      ++bin.count;
    }
    if (bin.count == 0) continue;
    bin.probability /= bin.count;
    bin.frequency /= bin.count;
    q.ece += std::abs(bin.probability - bin.frequency) * bin.count / static_cast<double>(n);
    q.bins.push_back(bin);
  }
}

}  // namespace

IntentionQuality intention_quality(const std::vector<const RunRecord*>& records) {
  IntentionQuality q;
  std::vector<const IntentionWindow*> windows;
  double lead_s = 0.0, alarms = 0.0, minutes = 0.0;
  for (const RunRecord* r : records) {
    for (const auto& window : r->windows) windows.push_back(&window);
    q.turns += r->metrics.turns;
    q.foreseen += r->metrics.foreseen;
    lead_s += r->metrics.lead_time_mean_s * r->metrics.foreseen;
    minutes += r->metrics.duration_s / 60.0;
    alarms += r->metrics.false_alarms_per_min * r->metrics.duration_s / 60.0;
  }
  if (q.foreseen > 0) q.lead_time_mean_s = lead_s / q.foreseen;
  if (minutes > 0.0) q.false_alarms_per_min = alarms / minutes;
  q.windows = static_cast<int>(windows.size());
  if (windows.empty()) return q;
  score(windows, q);
  fill_bins(windows, q);
  return q;
}

}  // namespace foretrack
