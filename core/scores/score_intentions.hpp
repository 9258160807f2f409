// SPDX-License-Identifier: Apache-2.0
// How good the probabilities of the intentions were.
#pragma once

#include <array>
#include <vector>

#include "core/scores/reliability.hpp"
#include "core/scores/truth.hpp"

namespace foretrack {

/// Of each intention, in the order of the enumeration; they sum to 1.
using Probabilities = std::array<double, kIntentionCount>;

/// What was predicted at a moment of the truth.
struct SaidIntention {
  double time_s = 0.0;
  Probabilities p{};
};

/// How well announcements told one kind of event. An intention is announced when its probability
/// has been above 0.5 for 0.08 s; gaps of up to 0.2 s are forgiven.
struct AnnouncementReport {
  int events = 0;    ///< that happened
  int by_onset = 0;  ///< of them: announced before they began
  /// From the announcement to the onset; negative: announced after it. An event that was not
  /// announced until 1 s after its onset counts as −1 s.
  double median_lead_s = 0.0;
  std::vector<double> leads_s;  ///< of every event, sorted
  /// Announcements without such an event from 0.8 s before them until 1 s after their end.
  double false_alarms_per_min = 0.0;
};

/// How good the probabilities were over all walks. "Base" is a forecast that always says the base
/// rates.
struct IntentionReport {
  int windows = 0;                             ///< moments that were judged, 0.2 s apart
  Probabilities base_rate{};                   ///< shares of the true intentions
  double brier = 0.0, base_brier = 0.0;        ///< sum over the intentions (Brier 1950); 0 is best
  double log_loss = 0.0, base_log_loss = 0.0;  ///< −log of the true one's probability; 0 is best
  double ece = 0.0, ece_turn = 0.0;  ///< calibration error: of the most probable one; of both turns
  std::vector<ReliabilityBin> reliability;       ///< of the most probable one; 15 bins
  std::vector<ReliabilityBin> turn_reliability;  ///< of both turns; 15 bins
  AnnouncementReport turns;                      ///< of each side's announcements
  AnnouncementReport either_turn;                ///< a turn was announced, to whichever side
  AnnouncementReport turn_backs;
  AnnouncementReport stops;
  double walked_min = 0.0;  ///< that the person walked

  /// 1: perfect; 0: no better than the base rates.
  double brier_skill() const { return base_brier > 0.0 ? 1.0 - brier / base_brier : 0.0; }
};

/// Collects walks, then reports. Definitions: docs/metrics.md.
class IntentionScorer {
 public:
  /// Adds one walk: all that was predicted, in order of time. Cost: linear in the truth's samples.
  void add(const std::vector<SaidIntention>& said, const Truth& truth);
  /// Adds another scorer's walks.
  IntentionScorer& operator+=(const IntentionScorer& other);
  /// Of all walks so far.
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
  Announcements turns_, either_turn_, stops_, turn_backs_;
  double walked_s_ = 0.0;

  AnnouncementReport report(const Announcements& a) const;
};

}  // namespace foretrack
