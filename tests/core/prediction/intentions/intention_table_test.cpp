// SPDX-License-Identifier: Apache-2.0
#include "core/prediction/intentions/intention_table.hpp"

#include <gtest/gtest.h>

#include "core/prediction/assess_intention.hpp"
#include "core/prediction/calibrate.hpp"
#include "core/prediction/predict.hpp"
#include "tests/core/prediction/worlds.hpp"

namespace foretrack {
namespace {

using namespace foretrack::testing;

constexpr Intention kSixth{kIntentionCount};

// A head of nothing but a constant.
template <int kLogit>
LogitView constant_weights(bool, bool) {
  static constexpr LogitWeights<1> weights{.row = {double{kLogit}}};
  return LogitView(weights);
}
template <int kLogit>
constexpr IntentionHead kHead{"sit_down", 1, constant_weights<kLogit>};

IntentionRow sit_down(const IntentionHead* head) {
  return {.id = kSixth,
          .name = "sit_down",
          .color_rgb = 0x808080,
          .margin = Margin::kDistance,
          .potential = [](const IntentionEvidence&) { return 3.0; },
          .observation = [](const IntentionEvidence&) { return 0.0; },
          .motion_model = [](const PredictionParams&,
                             const Gait&) { return MotionModel::deceleration(1.0); },
          .noise_m2_s3 = 0.1,
          .head = head,
          .features = [](const FeatureInputs&, FeatureVector& out) { out.add(1.0); }};
}

std::vector<IntentionRow> with(const IntentionRow& sixth) {
  std::vector<IntentionRow> table(kIntentions.begin(), kIntentions.end());
  table.push_back(sixth);
  return table;
}

PredictionResult predicted(IntentionTable table) {
  PredictionState state;
  PredictionParams params;
  params.path_probability_min = 0.0;
  return predict(state, walker({0, 0}, {1.5, 0.0}), open_field(), params, table);
}

TEST(IntentionTable, ASixthIntentionIsAssessedByItsOwnHead) {
  const auto rare = with(sit_down(&kHead<-3>)), likely = with(sit_down(&kHead<2>));
  const PredictionResult few = predicted(rare), many = predicted(likely);
  ASSERT_EQ(few.intention.count, kIntentionCount + 1);
  const double p = few.intention[kSixth].probability, q = many.intention[kSixth].probability;
  EXPECT_LT(p, 0.06);
  EXPECT_GT(q, 0.5);
  // Its odds against going on are those that its head says, and the others keep theirs (nearly:
  // heads with the chest and without it are mixed).
  EXPECT_NEAR(std::log(p / few.intention[Intention::kForward].probability), -3.0, 1e-9);
  EXPECT_NEAR(std::log(q / many.intention[Intention::kForward].probability), 2.0, 1e-9);
  const PredictionResult without = predicted(kIntentions);
  for (const IntentionRow& row : kIntentions)
    EXPECT_NEAR(many.intention[row.id].probability,
                (1.0 - q) * without.intention[row.id].probability, 1e-6)
        << row.name;
}

TEST(IntentionTable, ASixthIntentionHasAPathOfItsOwnMotion) {
  const auto table = with(sit_down(&kHead<2>));
  const PredictionResult result = predicted(table);
  const PredictedPath& path = result.prediction.paths.front();
  ASSERT_EQ(path.intention, kSixth);
  EXPECT_LT(path.states.back().velocity_enu_m_s.norm(), 1e-9);
  EXPECT_GT(result.intention.margins.distance, 0.9) << "planning makes the room it asks for";
}

TEST(IntentionTable, WithoutAFittedHeadItHasProbabilityZeroAndIsNamed) {
  const IntentionHead unfitted_head{"sit_down", 1, [](bool, bool) { return LogitView{}; }};
  for (const IntentionHead* head : {static_cast<const IntentionHead*>(nullptr), &unfitted_head}) {
    const auto table = with(sit_down(head));
    const PredictionResult result = predicted(table), without = predicted(kIntentions);
    EXPECT_EQ(result.intention[kSixth].probability, 0.0);
    for (const IntentionRow& row : kIntentions)
      EXPECT_EQ(result.intention[row.id].probability, without.intention[row.id].probability);
    EXPECT_EQ(unfitted(table), std::vector<std::string_view>{"sit_down"});
  }
}

// The build stops at a table that is not as it must be. Each fault, where nothing else is wrong:
template <class Edit>
constexpr std::string_view fault_after(Edit&& edit) {
  auto table = kIntentions;
  edit(table);
  return fault_of(table);
}
static_assert(fault_of(kIntentions).empty());
static_assert(fault_of({}) == "1 to 16 rows");
static_assert(fault_after([](auto& t) { std::swap(t[1], t[2]); }) == "each row at its place");
static_assert(!fault_after([](auto& t) { t[1].name = ""; }).empty());
static_assert(!fault_after([](auto& t) {
                 t[1].name = "a name that is longer than any message will take";
               }).empty());
static_assert(fault_after([](auto& t) { t[2].name = t[1].name; }) == "another name for each row");
static_assert(fault_after([](auto& t) { t[3].potential = nullptr; }) == "R, O and a motion model");
static_assert(fault_after([](auto& t) { t[3].motion_model = nullptr; }) ==
              "R, O and a motion model");
static_assert(fault_after([](auto& t) { t[0].head = t[1].head; }) ==
              "no head at place 0: its logit is 0");
static_assert(fault_after([](auto& t) { t[1].features = nullptr; }) ==
              "a head with features and weights");
static_assert(fault_after([](auto& t) { t[1].noise_m2_s3 = 0.0; }) == "noise above 0");

TEST(IntentionTable, FindsThePlaceOfAName) {
  for (const IntentionRow& row : kIntentions) EXPECT_EQ(intention_named(row.name), row.id);
  EXPECT_EQ(intention_named("sit_down"), std::nullopt);
}

TEST(IntentionTable, ChangingToAMirrorImageCostsMost) {
  const auto cost = [](Intention a, Intention b) { return change_cost(row_of(a), row_of(b)); };
  EXPECT_EQ(cost(Intention::kTurnLeft, Intention::kTurnLeft), 0.0);
  EXPECT_GT(cost(Intention::kTurnLeft, Intention::kTurnRight),
            cost(Intention::kDecelerate, Intention::kTurnRight));
  EXPECT_LT(cost(Intention::kTurnLeft, Intention::kForward),
            cost(Intention::kForward, Intention::kTurnLeft));
}

TEST(IntentionTable, NobodyWritesMoreFeaturesThanItsHeadHas) {
  const PredictionParams params;
  const MotionCues motion;
  const Surroundings surroundings;
  for (const IntentionRow& row : kIntentions) {
    if (!row.head) continue;
    FeatureVector features;
    row.features({{motion, surroundings, params}, IntentionBelief{}, true}, features);
    EXPECT_EQ(features.written(), row.head->features) << row.name;
  }
}

}  // namespace
}  // namespace foretrack
