// SPDX-License-Identifier: Apache-2.0
#include "services/convert/choice.hpp"

#include "convert_test_support.hpp"

namespace foretrack {
namespace {

using testing::kInf;
using testing::kNaN;
using ChoiceMsg = foretrack_msgs::msg::TargetChoice;

ChoiceReport doubt() {
  ChoiceReport report;
  report.stamp_s = 7.25;
  report.choice.status = ChoiceStatus::kDoubtful;
  report.choice.person_id = 3;
  report.choice.likeness = 0.8;
  report.choice.waits_s = 12.5;
  report.choice.count = 2;
  report.choice.candidates[0] = {3, 0.8, {1, 2, 1.2}};
  report.choice.candidates[1] = {9, 0.7, {4, 5, 1.3}};
  report.picture = {1, 2, 3};
  report.pictures[1] = {4, 5};
  return report;
}

ChoiceMsg message() {
  ChoiceMsg msg;
  to_idl(doubt(), msg);
  return msg;
}

TEST(TargetChoiceMessage, RoundTripsWithoutThePictures) {
  const auto out = from_idl(message());
  ASSERT_TRUE(out) << out.fault().text;
  EXPECT_EQ(out->stamp_s, 7.25);
  EXPECT_EQ(out->choice.status, ChoiceStatus::kDoubtful);
  EXPECT_EQ(out->choice.person_id, 3u);
  EXPECT_EQ(out->choice.likeness, 0.8);
  EXPECT_EQ(out->choice.waits_s, 12.5);
  ASSERT_EQ(out->choice.count, 2);
  EXPECT_EQ(out->choice.candidates[1].person_id, 9u);
  EXPECT_EQ(out->choice.candidates[1].likeness, 0.7);
  EXPECT_EQ(out->choice.candidates[1].torso_enu_m, Vec3(4, 5, 1.3));
}

TEST(TargetChoiceMessage, CarriesPicturesAsFarAsTheyFit) {
  ChoiceReport report = doubt();
  report.pictures[0].assign(16385, 7);
  ChoiceMsg msg;
  to_idl(report, msg);
  EXPECT_EQ(msg.picture().size(), 3u);
  EXPECT_TRUE(msg.candidates()[0].picture().empty()) << "too large";
  EXPECT_EQ(msg.candidates()[1].picture().size(), 2u);
}

TEST(TargetChoiceMessage, RefusesEachBadField) {
  using M = ChoiceMsg;
  testing::expect_each_refused<M>(
      message(),
      testing::header_faults<M>() +
          std::vector<testing::PlantedFault<M>>{
              {"choice.state", [](M& m) { m.state(5); }},
              {"choice.likeness", [](M& m) { m.likeness(1.5); }},
              {"choice.waits_s", [](M& m) { m.waits_s(kNaN); }},
              {"choice.picture", [](M& m) { m.picture().resize(20000); }},
              {"choice.candidates", [](M& m) { m.candidates().resize(5); }},
              {"choice.candidates.likeness", [](M& m) { m.candidates()[0].likeness(-1.0); }},
              {"choice.candidates.position_m",
               [](M& m) { m.candidates()[1].position_m()[2] = kInf; }},
              {"choice.candidates.picture",
               [](M& m) { m.candidates()[1].picture().resize(20000); }},
          },
      [](const M& m) { return from_idl(m); });
}

}  // namespace
}  // namespace foretrack
