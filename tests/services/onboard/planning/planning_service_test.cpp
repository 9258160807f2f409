// SPDX-License-Identifier: Apache-2.0
#include "services/onboard/planning/planning_service.hpp"

#include "services/convert/map.hpp"
#include "services/convert/prediction.hpp"
#include "services/convert/target.hpp"
#include "services/convert/trajectory.hpp"
#include "tests/services/onboard/neighbours.hpp"

namespace foretrack::testing {
namespace {

class PlanningOnDds : public ::testing::Test {
 protected:
  PlanningOnDds() { neighbours_.vehicle.position_enu_m = {0.0, 0.0, 1.5}; }

  void send_map(double stamp_s) {
    to_idl(free_map(stamp_s), map_.sample());
    map_.write();
  }
  void send_target(double stamp_s) {
    to_idl(walking_target(stamp_s), target_.sample());
    target_.write();
    Prediction prediction;
    prediction.stamp_s = stamp_s;
    prediction.status = PredictionStatus::kOk;
    PredictedPath path{{}, 1.0, {}};
    for (int k = 1; k <= 15; ++k)
      path.states.push_back({.time_s = 0.2 * k,
                             .position_enu_m = {2.0 + 0.2 * k, 0.0, 1.0},
                             .velocity_enu_m_s = {1.0, 0.0, 0.0}});
    prediction.paths = {path};
    to_idl(prediction, prediction_.sample());
    prediction_.write();
  }
  void feed() {
    neighbours_.send_odometry();
    send_target(neighbours_.now_s());
  }
  bool says(PlanStatus status) {
    plan_reader_.take_each([this](const auto& message) {
      const auto plan = from_idl(message);
      ASSERT_TRUE(plan) << plan.fault().text;
      plan_ = *plan;
      ++heard_;
    });
    return heard_ > 0 && plan_.status == status;
  }
  bool says(PlanStatus status, PlanReason reason) { return says(status) && plan_.reason == reason; }

  Neighbours neighbours_;
  Writer<topics::TargetState> target_{neighbours_.node()};
  Writer<topics::TargetPrediction> prediction_{neighbours_.node()};
  Writer<topics::LocalMap> map_{neighbours_.node()};
  Reader<topics::PlannedTrajectory> plan_reader_{neighbours_.node()};
  Running service_{[](const ServiceOptions& options, Stop& stop) {
    run_planning(options, PlanningParams{}, FleetParams{}, stop);
  }};
  PlannedTrajectory plan_;
  int heard_ = 0;
};

TEST_F(PlanningOnDds, WithoutInputsSaysSoTwentyTimesASecond) {
  ASSERT_TRUE(neighbours_.until([&] { return says(PlanStatus::kNone, PlanReason::kStaleInput); }));
  const double from_s = neighbours_.now_s();
  const int heard = heard_;
  ASSERT_TRUE(neighbours_.until([&] {
    says(PlanStatus::kNone);
    return neighbours_.now_s() > from_s + 1.0;
  }));
  EXPECT_GE(heard_ - heard, 5);  // of 20, on a machine that may be busy
  EXPECT_LE(heard_ - heard, 25);
}

TEST_F(PlanningOnDds, PlansInAKnownMapWithTheTargetsStamp) {
  send_map(0.0);
  ASSERT_TRUE(neighbours_.until([&] { return says(PlanStatus::kFresh); }, [&] { feed(); }));
  EXPECT_GT(plan_.stamp_s, neighbours_.now_s() - 2.0);
  EXPECT_LT((plan_.position(0.0) - neighbours_.vehicle.position_enu_m).norm(), 0.3);
}

TEST_F(PlanningOnDds, DoesNotPlanInAMapThatHasGrownOld) {
  send_map(neighbours_.now_s() - 60.0);
  ASSERT_TRUE(neighbours_.until(
      [&] { return says(PlanStatus::kNone, PlanReason::kStaleInput) && heard_ > 10; },
      [&] { feed(); }));
}

TEST_F(PlanningOnDds, SearchesWhenTheTargetCeases) {
  send_map(0.0);
  ASSERT_TRUE(neighbours_.until([&] { return says(PlanStatus::kFresh); }, [&] { feed(); }));
  ASSERT_TRUE(neighbours_.until([&] { return says(PlanStatus::kSearch, PlanReason::kTargetLost); },
                                [&] { neighbours_.send_odometry(); }));
}

TEST_F(PlanningOnDds, KeepsWhatIsFlownWhenTheOdometryCeases) {
  send_map(0.0);
  ASSERT_TRUE(neighbours_.until([&] { return says(PlanStatus::kFresh); }, [&] { feed(); }));
  EXPECT_TRUE(neighbours_.until([&] { return says(PlanStatus::kKept, PlanReason::kStaleInput); },
                                [&] { send_target(neighbours_.now_s()); }));
}

TEST_F(PlanningOnDds, RefusesGarbageAndGoesOn) {
  const auto send_garbage = [&] {
    feed();
    prediction_.sample().paths()[0].states()[3].position_m()[0] = kNaN;
    prediction_.write();
    prediction_.sample().paths().resize(100);
    prediction_.write();
    target_.sample().covariance()[0] = -1.0;
    target_.write();
    send_map(0.0);
    map_.sample().size_x(0);
    map_.write();
  };
  ASSERT_TRUE(neighbours_.until(
      [&] {
        return neighbours_.refused("target/prediction") >= 2 &&
               neighbours_.refused("target/state") > 0 && neighbours_.refused("map/local") > 0;
      },
      send_garbage));
  send_map(0.0);  // readers keep one map: a bad one displaces a good one
  EXPECT_TRUE(neighbours_.until([&] { return says(PlanStatus::kFresh); }, [&] { feed(); }))
      << to_string(plan_.status) << ": " << to_string(plan_.reason);
}

}  // namespace
}  // namespace foretrack::testing
