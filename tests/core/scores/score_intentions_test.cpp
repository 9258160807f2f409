// SPDX-License-Identifier: Apache-2.0
#include "core/scores/score_intentions.hpp"

#include <gtest/gtest.h>

#include "tests/core/scores/walks.hpp"

namespace foretrack {
namespace {

using namespace foretrack::testing;

constexpr Probabilities sure_of(Intention i, double p = 0.6) {
  Probabilities all{1.0 - p};
  all[index_of(i)] += p;
  return all;
}
constexpr Probabilities kForward = sure_of(Intention::kForward),
                        kLeft = sure_of(Intention::kTurnLeft),
                        kRight = sure_of(Intention::kTurnRight),
                        kBrake = sure_of(Intention::kDecelerate),
                        kBack = sure_of(Intention::kTurnBack);

struct Saying {
  double from_s, to_s;
  Probabilities p;
};

IntentionScorer scored(const Truth& truth, const std::vector<Saying>& sayings) {
  std::vector<SaidIntention> said;
  for (int i = 0; i < truth.count(); i += 2) {
    said.push_back({i * kStep_s, kForward});
    for (const Saying& s : sayings)
      if (said.back().time_s >= s.from_s - 1e-9 && said.back().time_s <= s.to_s + 1e-9)
        said.back().p = s.p;
  }
  IntentionScorer scorer;
  scorer.add(said, truth);
  return scorer;
}

TEST(IntentionScorer, LeadCountsFromTheEndOfTheHoldAndOtherAnnouncementsAreFalse) {
  const Truth truth = left_turn(12.0, 4.0);
  const double onset_s = turns_of(truth)[0].begin_s;
  const auto report =
      scored(truth, {{1.0, 1.2, kLeft}, {3.52, 4.6, kLeft}, {8.0, 8.2, kRight}}).report();
  ASSERT_EQ(report.turns.events, 1);
  EXPECT_EQ(report.turns.by_onset, 1);
  EXPECT_NEAR(report.turns.median_lead_s, onset_s - 3.6, 1e-9);
  EXPECT_NEAR(report.turns.false_alarms_per_min, 2.0 * 60.0 / 10.0, 0.2);
}

TEST(IntentionScorer, FlickerAnnouncesNothingAndGapsAreForgiven) {
  const Truth truth = left_turn(12.0, 4.0);
  const auto flicker = scored(truth, {{1.0, 1.05, kLeft}, {8.0, 8.05, kRight}}).report();
  EXPECT_EQ(flicker.turns.false_alarms_per_min, 0.0);
  EXPECT_EQ(flicker.turns.median_lead_s, -1.0);
  const auto gap = scored(truth, {{3.4, 3.6, kLeft}, {3.76, 4.6, kLeft}}).report();
  EXPECT_NEAR(gap.turns.median_lead_s, turns_of(truth)[0].begin_s - 3.48, 1e-9);
}

TEST(IntentionScorer, TheWrongSideAnnouncesATurnButNotThisOne) {
  const auto report = scored(left_turn(12.0, 4.0), {{3.6, 4.5, kRight}}).report();
  EXPECT_EQ(report.turns.by_onset, 0);
  EXPECT_EQ(report.either_turn.by_onset, 1);
  EXPECT_GT(report.turns.false_alarms_per_min, 0.0);
  EXPECT_EQ(report.either_turn.false_alarms_per_min, 0.0);
}

TEST(IntentionScorer, AStopIsAnnouncedLateForNothingForetellsIt) {
  const auto report = scored(sudden_stop(12.0, 4.0), {{4.2, 4.6, kBrake}}).report();
  ASSERT_EQ(report.stops.events, 1);
  EXPECT_NEAR(report.stops.median_lead_s, -0.28, 0.03);
  EXPECT_EQ(report.stops.false_alarms_per_min, 0.0);
}

TEST(IntentionScorer, ATurnBackIsAnnouncedByItsOwnProbability) {
  const auto report = scored(turn_back(12.0, 4.0), {{3.0, 4.4, kBack}}).report();
  ASSERT_EQ(report.turn_backs.events, 1);
  EXPECT_EQ(report.turn_backs.by_onset, 1);
  EXPECT_NEAR(report.turn_backs.median_lead_s, 4.0 - 3.08, 0.03);
  EXPECT_EQ(report.stops.events, 0) << "who slows down to turn back does not stop";
}

TEST(IntentionScorer, TheTruthHasSkillOneAndTheBaseRatesHaveNone) {
  const Truth truth = left_turn(10.0, 4.0);
  std::vector<SaidIntention> said;
  for (int i = 0; i < truth.count(); ++i)
    if (const auto label = label_at(truth, i)) {
      said.push_back({i * kStep_s, {}});
      said.back().p[index_of(*label)] = 1.0;
    }
  IntentionScorer sure;
  sure.add(said, truth);
  EXPECT_NEAR(sure.report().brier_skill(), 1.0, 1e-9);
  EXPECT_NEAR(sure.report().log_loss, 0.0, 1e-9);
  for (auto& s : said) s.p = sure.report().base_rate;
  IntentionScorer base;
  base.add(said, truth);
  EXPECT_NEAR(base.report().brier_skill(), 0.0, 1e-9);
  EXPECT_NEAR(base.report().log_loss, base.report().base_log_loss, 1e-9);
  IntentionScorer both = sure;
  both += base;
  EXPECT_EQ(both.report().windows, 2 * sure.report().windows);
  EXPECT_NEAR(both.report().brier, 0.5 * base.report().brier, 1e-9);
}

}  // namespace
}  // namespace foretrack
