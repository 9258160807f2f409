// SPDX-License-Identifier: Apache-2.0
// How good the probabilities of the intentions were.
#pragma once

#include <array>
#include <vector>

#include "core/scores/reliability.hpp"
#include "core/scores/truth.hpp"

namespace foretrack {

using Probabilities = std::array<double, kIntentionCount>;

/// What was said at a moment of the truth.
struct SaidIntention {
  double time_s = 0.0;
  Probabilities p{};
};

/// Announcements of one kind of event: p > 0.5 for at least 0.08 s, gaps up to 0.2 s forgiven,
/// counted from the end of those 0.08 s.
struct AnnouncementReport {
  int events = 0;
  int by_onset = 0;             // announced when they began
  double median_lead_s = 0.0;   // before the onset; not announced until 1 s after it: −1
  std::vector<double> leads_s;  // sorted
  /// Announcements without such an event from 0.8 s before them until 1 s after.
  double false_alarms_per_min = 0.0;
};

struct IntentionReport {
  int windows = 0;  // 0.2 s apart
  Probabilities base_rate{};
  double brier = 0.0, base_brier = 0.0;  // base: of always saying the base rates
  double log_loss = 0.0, base_log_loss = 0.0;
  double ece = 0.0, ece_turn = 0.0;         // of the most probable intention; of both turns
  std::vector<ReliabilityBin> reliability;  // 15 bins of equal mass
  std::vector<ReliabilityBin> turn_reliability;
  AnnouncementReport turns, either_turn, stops;  // either: left or right
  double walked_min = 0.0;

  double brier_skill() const { return base_brier > 0.0 ? 1.0 - brier / base_brier : 0.0; }
};

/// Collects walks, then reports. Definitions: docs/metrics.md.
class IntentionScorer {
 public:
  /// One walk: all that was said, in order of time. Cost: linear in the truth's samples.
  void add(const std::vector<SaidIntention>& said, const Truth& truth);
  IntentionScorer& operator+=(const IntentionScorer& other);
  IntentionReport report() const;

 private:
  struct Window {
    Probabilities p;
    int label;
  };
  struct Announcements {
    std::vector<double> leads_s;
    int false_alarms = 0;
  };
  std::vector<Window> windows_;
  Announcements turns_, either_turn_, stops_;
  double walked_s_ = 0.0;

  AnnouncementReport report(const Announcements& a) const;
};

}  // namespace foretrack
