// SPDX-License-Identifier: Apache-2.0
#include "core/scores/score_intentions.hpp"

#include <algorithm>
#include <cmath>

namespace foretrack {
namespace {

constexpr int kBins = 15;
constexpr double kEvery_s = 0.2;  // between judged windows
constexpr double kAlarm = 0.5;    // probability that counts as an announcement
constexpr double kHold_s = 0.08;  // shorter is flicker; an announcement counts from its end
constexpr double kForgiven_gap_s = 0.2;
constexpr double kEarliest_s = 1.0;    // an announcement is right if the event begins within this
constexpr double kLatest_s = 0.8;      // or began this long before
constexpr double kNever_s = -1.0;      // lead of an event that was not announced
constexpr double kLongestGap_s = 0.1;  // between moments; a longer one is not walked time
constexpr double kAfterwards_s = 1.0;
constexpr double kLeastProbability = 1e-9;
constexpr int kLeft = index_of(Intention::kTurnLeft), kRight = index_of(Intention::kTurnRight);

using Moments = std::vector<SaidIntention>;
using Events = std::vector<TruthEvent>;

struct Run {
  double from_s, to_s;
};

// Times over which something was announced without a gap.
template <class ProbabilityOf>
std::vector<Run> announcements(const Moments& moments, ProbabilityOf&& probability_of) {
  std::vector<Run> runs;
  for (const SaidIntention& m : moments) {
    if (probability_of(m.p) <= kAlarm) continue;
    if (!runs.empty() && m.time_s - runs.back().to_s <= kForgiven_gap_s)
      runs.back().to_s = m.time_s;
    else
      runs.push_back({m.time_s, m.time_s});
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

int false_among(const std::vector<Run>& runs, const Events& events) {
  const auto is_false = [&](const Run& run) {
    return std::none_of(events.begin(), events.end(), [&](const TruthEvent& e) {
      return e.begin_s >= run.from_s - kLatest_s && e.begin_s <= run.to_s + kEarliest_s;
    });
  };
  return static_cast<int>(std::count_if(runs.begin(), runs.end(), is_false));
}

template <class Announcements, class ProbabilityOf>
void judge(const Moments& moments, const Events& events, ProbabilityOf&& probability_of,
           Announcements& out) {
  const std::vector<Run> runs = announcements(moments, probability_of);
  for (const TruthEvent& e : events) out.leads_s.push_back(lead_s(runs, e.begin_s));
  out.false_alarms += false_among(runs, events);
}

Events only(const Events& events, std::initializer_list<Intention> kinds) {
  Events some;
  std::ranges::copy_if(events, std::back_inserter(some), [&](const TruthEvent& e) {
    return std::ranges::find(kinds, e.kind) != kinds.end();
  });
  return some;
}

// Announcements of one intention's events.
template <class Announcements>
void judge(const Moments& moments, const Events& events, Intention kind, Announcements& out) {
  judge(
      moments, only(events, {kind}), [&](const Probabilities& p) { return p[index_of(kind)]; },
      out);
}

template <class T>
void append(std::vector<T>& all, const std::vector<T>& more) {
  all.insert(all.end(), more.begin(), more.end());
}

double square(double x) {
  return x * x;
}

}  // namespace

void IntentionScorer::add(const Moments& said, const Truth& truth) {
  Moments walking, stopping;  // the latter with what is said just after they stand
  double next_window_s = 0.0;
  for (const SaidIntention& m : said) {
    if (!truth.knows(m.time_s)) continue;
    const auto label = label_at(truth, truth.steps(m.time_s));
    if (label || (!walking.empty() && m.time_s - walking.back().time_s <= kAfterwards_s))
      stopping.push_back(m);
    if (!label) continue;
    if (!walking.empty() && m.time_s - walking.back().time_s < kLongestGap_s)
      walked_s_ += m.time_s - walking.back().time_s;
    walking.push_back(m);
    if (m.time_s < next_window_s - 1e-6) continue;
    next_window_s = m.time_s + kEvery_s;
    windows_.push_back({m.p, index_of(*label)});
  }
  const Events events = intended_events_of(truth);
  judge(
      walking, only(events, {Intention::kTurnLeft, Intention::kTurnRight}),
      [](const Probabilities& p) { return p[kLeft] + p[kRight]; }, either_turn_);
  judge(walking, events, Intention::kTurnLeft, turns_);
  judge(walking, events, Intention::kTurnRight, turns_);
  judge(stopping, events, Intention::kTurnBack, turn_backs_);
  judge(stopping, events, Intention::kDecelerate, stops_);
}

IntentionScorer& IntentionScorer::operator+=(const IntentionScorer& o) {
  append(windows_, o.windows_);
  const auto add = [](Announcements& a, const Announcements& b) {
    append(a.leads_s, b.leads_s);
    a.false_alarms += b.false_alarms;
  };
  add(turns_, o.turns_);
  add(either_turn_, o.either_turn_);
  add(stops_, o.stops_);
  add(turn_backs_, o.turn_backs_);
  walked_s_ += o.walked_s_;
  return *this;
}

AnnouncementReport IntentionScorer::report(const Announcements& a) const {
  AnnouncementReport r;
  r.leads_s = a.leads_s;
  std::sort(r.leads_s.begin(), r.leads_s.end());
  r.events = static_cast<int>(r.leads_s.size());
  if (r.events > 0) r.median_lead_s = r.leads_s[r.leads_s.size() / 2];
  for (const double lead : r.leads_s) r.by_onset += lead > 0.0;
  if (walked_s_ > 0.0) r.false_alarms_per_min = 60.0 * a.false_alarms / walked_s_;
  return r;
}

IntentionReport IntentionScorer::report() const {
  IntentionReport r;
  r.turns = report(turns_);
  r.either_turn = report(either_turn_);
  r.stops = report(stops_);
  r.turn_backs = report(turn_backs_);
  r.walked_min = walked_s_ / 60.0;
  r.windows = static_cast<int>(windows_.size());
  const double n = std::max(r.windows, 1);
  for (const Window& w : windows_) r.base_rate[w.label] += 1.0 / n;
  std::vector<std::pair<double, bool>> best_pairs, turn_pairs;
  for (const Window& w : windows_) {
    for (int i = 0; i < kIntentionCount; ++i) {
      r.brier += square(w.p[i] - (i == w.label)) / n;
      r.base_brier += square(r.base_rate[i] - (i == w.label)) / n;
    }
    r.log_loss -= std::log(std::max(kLeastProbability, w.p[w.label])) / n;
    r.base_log_loss -= std::log(r.base_rate[w.label]) / n;
    const int best = static_cast<int>(std::max_element(w.p.begin(), w.p.end()) - w.p.begin());
    best_pairs.emplace_back(w.p[best], best == w.label);
    for (const int side : {kLeft, kRight}) turn_pairs.emplace_back(w.p[side], w.label == side);
  }
  r.reliability = reliability_bins(std::move(best_pairs), kBins);
  r.turn_reliability = reliability_bins(std::move(turn_pairs), kBins);
  r.ece = expected_calibration_error(r.reliability);
  r.ece_turn = expected_calibration_error(r.turn_reliability);
  return r;
}

}  // namespace foretrack
