// SPDX-License-Identifier: Apache-2.0
#include "services/convert/prediction.hpp"

#include "convert_test_support.hpp"
#include "core/prediction/assess_intention.hpp"

namespace foretrack {
namespace {

using testing::kInf;
using testing::kNaN;
using IntentionMsg = foretrack_msgs::msg::TargetIntention;
using PredictionMsg = foretrack_msgs::msg::TargetPrediction;

IntentionAssessment assessment() {
  IntentionAssessment a;
  a.stamp_s = 7.25;
  a.count = kIntentionCount;
  for (int i = 0; i < kIntentionCount; ++i)
    a.beliefs[i] = {0.1 * i, 0.2 * i, 0.9 * i / kIntentionCount, 0.1};
  a.beliefs[0].probability = 1.0 - 0.1 * (kIntentionCount - 1);
  a.margins = margin_scores(a);
  a.region = {.center_enu_m = {1, 2, 3},
              .radius_m = 1.5,
              .heading_rad = 0.3,
              .left_half_angle_rad = 0.4,
              .right_half_angle_rad = 0.7};
  a.region_ahead = a.region;
  a.region_ahead.radius_m = 2.0;
  a.obstacle_distance_m = 4.0;
  a.body_turn_rad = -0.2;
  return a;
}

Prediction prediction() {
  Prediction p;
  p.stamp_s = 7.25;
  p.status = PredictionStatus::kOk;
  p.expansions = 42;
  for (int i = 0; i < 2; ++i) {
    PredictedPath path{static_cast<Intention>(i), i == 0 ? 0.75 : 0.25, {}};
    for (int k = 1; k <= 15; ++k)
      path.states.push_back({.time_s = 0.2 * k,
                             .position_enu_m = {0.3 * k, 0.1 * i, 1.0},
                             .velocity_enu_m_s = {1.5, 0.0, 0.0},
                             .covariance_m2 = Mat2::Identity() * 0.01 * k});
    p.paths.push_back(path);
  }
  return p;
}

template <class Msg, class Core>
Msg message(const Core& core) {
  Msg msg;
  to_idl(core, msg);
  return msg;
}

TEST(TargetIntentionMessage, RoundTrips) {
  const IntentionAssessment in = assessment();
  const auto out = from_idl(message<IntentionMsg>(in));
  ASSERT_TRUE(out) << out.fault().text;
  for (int i = 0; i < kIntentionCount; ++i) {
    EXPECT_EQ(out->beliefs[i].potential, in.beliefs[i].potential);
    EXPECT_EQ(out->beliefs[i].observation, in.beliefs[i].observation);
    EXPECT_EQ(out->beliefs[i].score, in.beliefs[i].score);
    EXPECT_EQ(out->beliefs[i].probability, in.beliefs[i].probability);
  }
  EXPECT_EQ(out->stamp_s, in.stamp_s);
  EXPECT_EQ(out->region.center_enu_m, in.region.center_enu_m);
  EXPECT_EQ(out->region.right_bisector_rad(), in.region.right_bisector_rad());
  EXPECT_EQ(out->region_ahead.radius_m, 2.0);
  EXPECT_EQ(out->obstacle_distance_m, in.obstacle_distance_m);
  EXPECT_EQ(out->body_turn_rad, in.body_turn_rad);
}

TEST(TargetIntentionMessage, TellsIntentionsByTheirNamesInAnyOrder) {
  IntentionMsg m = message<IntentionMsg>(assessment());
  std::swap(m.intentions().front(), m.intentions().back());
  const auto out = from_idl(m);
  ASSERT_TRUE(out) << out.fault().text;
  for (const IntentionRow& row : kIntentions)
    EXPECT_EQ((*out)[row.id].probability, assessment()[row.id].probability) << row.name;
  EXPECT_EQ(out->margins.left, assessment()[Intention::kTurnLeft].score);
}

TEST(TargetIntentionMessage, ThoseThatAMessageLacksHaveProbabilityZero) {
  IntentionMsg m = message<IntentionMsg>(assessment());
  m.intentions().resize(1);
  m.intentions()[0].probability(1.0);
  const auto out = from_idl(m);
  ASSERT_TRUE(out) << out.fault().text;
  EXPECT_EQ(out->count, kIntentionCount);
  EXPECT_EQ((*out)[Intention::kForward].probability, 1.0);
  EXPECT_EQ((*out)[Intention::kTurnLeft].probability, 0.0);
}

TEST(TargetIntentionMessage, CountsNamesThatItDoesNotKnowAndGivesTheirProbabilityToNobody) {
  IntentionMsg m = message<IntentionMsg>(assessment());
  auto& stranger = m.intentions().emplace_back(m.intentions()[0]);
  stranger.name("sit_down");
  stranger.probability(0.25);
  m.intentions()[0].probability(m.intentions()[0].probability() - 0.25);
  const auto out = from_idl(m);
  ASSERT_TRUE(out) << out.fault().text;
  EXPECT_EQ(out->unknown, 1);
  double sum = 0.0;
  for (const IntentionRow& row : kIntentions) sum += (*out)[row.id].probability;
  EXPECT_NEAR(sum, 0.75, 1e-12);
}

TEST(TargetIntentionMessage, SaysNameAndColourOfEachRow) {
  const IntentionMsg m = message<IntentionMsg>(assessment());
  ASSERT_EQ(m.intentions().size(), kIntentions.size());
  for (const IntentionRow& row : kIntentions) {
    const auto& said = m.intentions()[index_of(row.id)];
    EXPECT_EQ(std::string_view(said.name().c_str()), row.name);
    EXPECT_EQ(said.color_rgb(), row.color_rgb);
  }
}

TEST(TargetIntentionMessage, RefusesEachBadField) {
  using M = IntentionMsg;
  testing::expect_each_refused<M>(
      message<M>(assessment()),
      testing::header_faults<M>() +
          std::vector<testing::PlantedFault<M>>{
              {"intentions", [](M& m) { m.intentions().clear(); }},
              {"intentions", [](M& m) { m.intentions().resize(17); }},
              {"intentions", [](M& m) { m.intentions().resize(5000); }},
              {"intentions.name", [](M& m) { m.intentions()[2].name(m.intentions()[1].name()); }},
              {"intentions.potential", [](M& m) { m.intentions()[2].potential(kNaN); }},
              {"intentions.observation", [](M& m) { m.intentions()[2].observation(kInf); }},
              {"intentions.score", [](M& m) { m.intentions()[0].score(1.1); }},
              {"intentions.probability", [](M& m) { m.intentions()[0].probability(-0.1); }},
              {"intentions.probability", [](M& m) { m.intentions()[0].probability(0.5); }},
              {"region.radius_m", [](M& m) { m.region_now().radius_m(-1.0); }},
              {"region.center_m", [](M& m) { m.region_ahead().center_m()[0] = kNaN; }},
              {"region.heading_rad", [](M& m) { m.region_ahead().heading_rad(kNaN); }},
              {"region.left_half_angle_rad", [](M& m) { m.region_now().left_half_angle_rad(4.0); }},
              {"obstacle_distance_m", [](M& m) { m.obstacle_distance_m(kInf); }},
              {"body_turn_angle_rad", [](M& m) { m.body_turn_angle_rad(4.0); }},
          },
      [](const M& m) { return from_idl(m); });
}

TEST(TargetPredictionMessage, RoundTrips) {
  const Prediction in = prediction();
  const auto out = from_idl(message<PredictionMsg>(in));
  ASSERT_TRUE(out) << out.fault().text;
  EXPECT_EQ(out->stamp_s, in.stamp_s);
  EXPECT_EQ(out->status, in.status);
  EXPECT_EQ(out->expansions, in.expansions);
  ASSERT_EQ(out->paths.size(), in.paths.size());
  for (std::size_t i = 0; i < in.paths.size(); ++i) {
    EXPECT_EQ(out->paths[i].intention, in.paths[i].intention);
    EXPECT_EQ(out->paths[i].probability, in.paths[i].probability);
    ASSERT_EQ(out->paths[i].states.size(), in.paths[i].states.size());
    for (std::size_t k = 0; k < in.paths[i].states.size(); ++k) {
      const PredictedState &a = in.paths[i].states[k], &b = out->paths[i].states[k];
      EXPECT_EQ(a.time_s, b.time_s);
      EXPECT_EQ(a.position_enu_m, b.position_enu_m);
      EXPECT_EQ(a.velocity_enu_m_s, b.velocity_enu_m_s);
      EXPECT_EQ(a.covariance_m2, b.covariance_m2);
    }
  }
}

TEST(TargetPredictionMessage, CarriesPathsOfIntentionsThatItDoesNotKnow) {
  PredictionMsg m = message<PredictionMsg>(prediction());
  m.paths()[1].name("sit_down");
  const auto out = from_idl(m);
  ASSERT_TRUE(out) << out.fault().text;
  ASSERT_EQ(out->paths.size(), 2u);
  EXPECT_EQ(out->paths[1].intention, kUnknownIntention);
  EXPECT_EQ(out->paths[1].probability, 0.25);
}

TEST(TargetPredictionMessage, NoTargetNeedsNoPaths) {
  const auto out = from_idl(message<PredictionMsg>(Prediction{}));
  ASSERT_TRUE(out) << out.fault().text;
  EXPECT_EQ(out->status, PredictionStatus::kNoTarget);
}

TEST(TargetPredictionMessage, RefusesEachBadField) {
  using M = PredictionMsg;
  testing::expect_each_refused<M>(
      message<M>(prediction()),
      testing::header_faults<M>() +
          std::vector<testing::PlantedFault<M>>{
              {"status", [](M& m) { m.status(9); }},
              {"paths", [](M& m) { m.paths().clear(); }},
              {"paths", [](M& m) { m.paths().resize(17); }},
              {"paths.probability", [](M& m) { m.paths()[0].probability(kNaN); }},
              {"paths.probability", [](M& m) { m.paths()[0].probability(0.5); }},
              {"paths.states", [](M& m) { m.paths()[1].states().clear(); }},
              {"paths.states", [](M& m) { m.paths()[1].states().resize(1000); }},
              {"paths.states.time_from_stamp_s",
               [](M& m) { m.paths()[0].states()[0].time_from_stamp_s(0.0); }},
              {"paths.states.time_from_stamp_s",
               [](M& m) { m.paths()[0].states()[5].time_from_stamp_s(0.1); }},
              {"paths.states.time_from_stamp_s",
               [](M& m) { m.paths()[0].states()[5].time_from_stamp_s(kNaN); }},
              {"paths.states.position_m",
               [](M& m) { m.paths()[0].states()[5].position_m()[0] = kNaN; }},
              {"paths.states.velocity_mps",
               [](M& m) { m.paths()[0].states()[5].velocity_mps()[2] = -kInf; }},
              {"paths.states.covariance_xy_m2",
               [](M& m) { m.paths()[0].states()[5].covariance_xy_m2()[1] = 1.0; }},
          },
      [](const M& m) { return from_idl(m); });
}

TEST(TargetPredictionMessage, ThrowsRatherThanSendBeyondItsBounds) {
  Prediction long_path = prediction(), many_paths = prediction();
  long_path.paths[0].states.resize(65);
  many_paths.paths.resize(17);
  PredictionMsg msg;
  EXPECT_THROW(to_idl(long_path, msg), std::length_error);
  EXPECT_THROW(to_idl(many_paths, msg), std::length_error);
}

}  // namespace
}  // namespace foretrack
