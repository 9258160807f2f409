// SPDX-License-Identifier: Apache-2.0
// The scenario around a vehicle whose odometry comes from elsewhere, slower than time passes.
#include "services/simulator/around_px4.hpp"

#include <cmath>

#include "services/convert/px4.hpp"
#include "services/convert/target.hpp"
#include "tests/services/onboard/neighbours.hpp"

namespace foretrack::testing {
namespace {

constexpr double kSlow = 0.965;  // of real time, as PX4's simulation runs on a busy machine
constexpr double kBoot_s = 37.0;

Scenario lane() {
  Scenario s;
  s.world.min_m = {-10, -10, 0};
  s.world.max_m = {30, 10, 4};
  s.target.route_m = {{0, 0}, {20, 0}};
  s.target.person.start_s = 0.5;
  s.vehicle_enu_m = Vec3(-2.0, 0.0, 1.5);
  return s;
}

// PX4 as the bus has it: it stands, headed north, and its time is its own.
class AroundPx4OnDds : public ::testing::Test {
 protected:
  void start(double people_wait_s) {
    service_.emplace([=](ServiceOptions options, Stop& stop) {
      options.names.px4_release = "1.16";
      run_around_px4(options, lane(), {.endless = true, .people_wait_s = people_wait_s}, stop);
    });
  }
  bool until(const std::function<bool()>& condition) {
    return neighbours_.until(
        [&] {
          clock_.take_each(
              [this](const auto& clock) { times_.push_back(to_seconds(clock.clock())); });
          truth_.take_each([this](const auto& odometry) {
            person_enu_m_ = {odometry.pose().pose().position().x(),
                             odometry.pose().pose().position().y(),
                             odometry.pose().pose().position().z()};
          });
          return condition();
        },
        [&] {
          now_s_ += kSlow * 0.02;
          vehicle_.stamp_s = now_s_;
          to_idl(vehicle_, odometry_.sample());
          odometry_.write();
          AutopilotStatus status{.stamp_s = now_s_, .armed = flies_, .offboard = flies_};
          status.mode = flies_ ? FlightMode::kOffboard : FlightMode::kHold;
          to_idl(status, status_.sample());
          status_.write();
        });
  }
  double walked_m() const { return (person_enu_m_ - Vec3(0, 2, person_enu_m_.z())).norm(); }

  Neighbours neighbours_;
  Writer<topics::Px4VehicleOdometry> odometry_{neighbours_.node()};
  Writer<topics::Px4VehicleStatus> status_{neighbours_.node()};
  Reader<topics::Clock> clock_{neighbours_.node()};
  Reader<topics::TargetTruth> truth_{neighbours_.node()};
  Reader<topics::TargetObservation> observation_{neighbours_.node()};
  double now_s_ = kBoot_s;
  bool flies_ = false;
  VehicleState vehicle_{.q_world_body = Quat(Eigen::AngleAxisd(0.5 * kPi, Vec3::UnitZ()))};
  std::vector<double> times_;
  Vec3 person_enu_m_ = Vec3::Constant(kNaN);
  std::optional<Running> service_;
};

TEST_F(AroundPx4OnDds, TheClockIsPx4sInItsOwnStepsAndThePersonIsAhead) {
  start(3600.0);
  ASSERT_TRUE(until([&] { return times_.size() > 100 && !std::isnan(person_enu_m_.x()); }));
  EXPECT_GE(times_.front(), kBoot_s);
  EXPECT_LE(times_.back(), now_s_ + 1e-6);
  EXPECT_TRUE(std::is_sorted(times_.begin(), times_.end()));
  for (std::size_t i = 1; i < times_.size(); ++i)
    EXPECT_LE(times_[i] - times_[i - 1], 0.05) << "each step of it is told";
  EXPECT_NEAR(person_enu_m_.x(), 0.0, 1e-3);
  EXPECT_NEAR(person_enu_m_.y(), 2.0, 1e-3) << "north of the vehicle, which is headed there";
  EXPECT_TRUE(until([&] {
    const auto seen = observation_.take_newest_as(
        [](const foretrack_msgs::msg::TargetObservation& m) { return from_idl(m); });
    return seen && std::abs(seen->stamp_s - now_s_) < 0.3;
  })) << "stamped in PX4's time";
}

TEST_F(AroundPx4OnDds, PeopleStandUntilTheVehicleFliesByUsAndThenWalkInPx4sTime) {
  start(3600.0);
  const double waited_s = now_s_ + 2.0;
  ASSERT_TRUE(until([&] { return now_s_ > waited_s && !std::isnan(person_enu_m_.x()); }));
  EXPECT_LT(walked_m(), 0.01);
  flies_ = true;
  const double set_off_s = now_s_;
  ASSERT_TRUE(until([&] { return walked_m() > 2.0; }));
  EXPECT_GT(now_s_ - set_off_s, 2.0 / lane().target.speed_m_s) << "no faster than a person walks";
}

TEST_F(AroundPx4OnDds, WithoutOdometryTimeStandsAndNobodyMoves) {
  start(0.0);
  ASSERT_TRUE(until([&] { return walked_m() > 0.5; }));
  const Vec3 place = person_enu_m_;
  now_s_ += 30.0;  // the agent was away
  const double after_s = now_s_;
  ASSERT_TRUE(until([&] { return !times_.empty() && times_.back() > after_s; }));
  EXPECT_LT((person_enu_m_ - place).norm(), 1.0);
}

TEST_F(AroundPx4OnDds, BeginsAnewWhenPx4IsRestarted) {
  start(0.0);
  ASSERT_TRUE(until([&] { return walked_m() > 1.0; }));
  now_s_ = 3.0;
  EXPECT_TRUE(until([&] { return walked_m() < 0.1 && times_.back() < kBoot_s; }));
}

}  // namespace
}  // namespace foretrack::testing
