// SPDX-License-Identifier: Apache-2.0
#include "services/operator/view.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "services/common/rate.hpp"
#include "services/operator/snapshot_json.hpp"

namespace foretrack {
namespace {

using testing::HasSubstr;
using testing::Not;

TEST(View, DrawsAnEmptyPictureWithoutInventingAnything) {
  const std::string text = draw({}, {});
  EXPECT_THAT(text, HasSubstr("person     not known yet"));
  EXPECT_THAT(text, HasSubstr("distance   not known yet"));
  EXPECT_THAT(text, Not(HasSubstr("\033")));
}

TEST(View, MarksTheDistanceInsideItsBand) {
  nav_msgs::msg::Odometry vehicle, target;
  target.pose().pose().position().x(2.0);
  FlightSnapshot snapshot;
  snapshot.vehicle_truth = &vehicle;
  snapshot.target_truth = &target;
  ViewOptions options;
  options.colors = true;
  EXPECT_THAT(draw(snapshot, options), HasSubstr("\033[32m 2.0 m"));
  target.pose().pose().position().x(4.0);
  EXPECT_THAT(draw(snapshot, options), HasSubstr("\033[31m 4.0 m"));
}

TEST(View, NamesTheMostProbableIntentionInTheStatusLine) {
  foretrack_msgs::msg::TargetIntention intention;
  for (const auto& [name, p] :
       {std::pair{"forward", 0.2}, {"turn_left", 0.7}, {"decelerate", 0.1}}) {
    intention.intentions().emplace_back();
    intention.intentions().back().name(name);
    intention.intentions().back().probability(p);
  }
  FlightSnapshot snapshot;
  snapshot.intention = &intention;
  EXPECT_THAT(status_line(snapshot, {}), HasSubstr("turn_left 0.70"));
  EXPECT_DOUBLE_EQ(to_json(snapshot)["intention"]["turn_left"], 0.7);
}

TEST(View, SaysWhyAServiceIsDegraded) {
  FlightSnapshot snapshot;
  snapshot.services.emplace_back();
  auto& health = snapshot.services.back().health;
  health.service("perception");
  health.last_error("several people could be the one who is followed");
  health.state(foretrack_msgs::msg::ServiceHealth_Constants::STATE_RUNNING);
  EXPECT_THAT(draw(snapshot, {}), Not(HasSubstr("several people")));
  health.state(foretrack_msgs::msg::ServiceHealth_Constants::STATE_DEGRADED);
  EXPECT_THAT(draw(snapshot, {}), HasSubstr("several people could be the one who is followed"));
}

TEST(Rate, IsThatOfTheLastSecondsOnly) {
  RateMeter meter;
  double rate_hz = 0.0;
  std::uint64_t count = 0;
  for (int i = 0; i < 100; ++i) rate_hz = meter.update(count += 5, 0.05 * i);
  EXPECT_NEAR(rate_hz, 100.0, 1.0);
  for (int i = 100; i < 160; ++i) rate_hz = meter.update(count, 0.05 * i);
  EXPECT_EQ(rate_hz, 0.0) << "nothing came for three seconds";
}

}  // namespace
}  // namespace foretrack
