// SPDX-License-Identifier: Apache-2.0
#include "services/onboard/prediction/prediction_service.hpp"

#include "services/convert/map.hpp"
#include "services/convert/prediction.hpp"
#include "services/convert/target.hpp"
#include "tests/services/onboard/neighbours.hpp"

namespace foretrack::testing {
namespace {

class PredictionOnDds : public ::testing::Test {
 protected:
  void feed() {
    to_idl(walking_target(neighbours_.now_s()), target_.sample());
    target_.write();
  }
  bool says(PredictionStatus status) {
    prediction_reader_.take_each([this](const auto& message) {
      const auto prediction = from_idl(message);
      ASSERT_TRUE(prediction) << prediction.fault().text;
      prediction_ = *prediction;
      heard_ = true;
    });
    return heard_ && prediction_.status == status;
  }

  Neighbours neighbours_;
  Writer<topics::TargetState> target_{neighbours_.node()};
  Writer<topics::LocalMap> map_{neighbours_.node()};
  Reader<topics::TargetPrediction> prediction_reader_{neighbours_.node()};
  Reader<topics::TargetIntention> intention_reader_{neighbours_.node()};
  Running service_{[](const ServiceOptions& options, Stop& stop) {
    run_prediction(options, PredictionParams{}, stop);
  }};
  Prediction prediction_;
  bool heard_ = false;
};

TEST_F(PredictionOnDds, SaysThatThereIsNoTarget) {
  EXPECT_TRUE(neighbours_.until([&] { return says(PredictionStatus::kNoTarget); }));
}

TEST_F(PredictionOnDds, PredictsAWalkWithTheTargetsStamp) {
  to_idl(free_map(neighbours_.now_s()), map_.sample());
  map_.write();
  ASSERT_TRUE(neighbours_.until([&] { return says(PredictionStatus::kOk); }, [&] { feed(); }));
  EXPECT_LT(std::abs(prediction_.stamp_s - neighbours_.now_s()), 1.0);
  EXPECT_EQ(prediction_.paths.front().intention, Intention::kForward);
  const auto* intention = intention_reader_.take_newest();
  ASSERT_NE(intention, nullptr);
  const auto assessment = from_idl(*intention);
  EXPECT_TRUE(assessment) << assessment.fault().text;
}

TEST_F(PredictionOnDds, SaysWhenTheTargetCeases) {
  ASSERT_TRUE(neighbours_.until([&] { return says(PredictionStatus::kOk); }, [&] { feed(); }));
  EXPECT_TRUE(neighbours_.until([&] { return says(PredictionStatus::kNoTarget); }));
}

TEST_F(PredictionOnDds, RefusesGarbageAndGoesOn) {
  const auto send_garbage = [&] {
    feed();
    target_.sample().velocity_mps()[0] = kNaN;
    target_.write();
    feed();
    target_.sample().status(200);
    target_.write();
    to_idl(free_map(neighbours_.now_s()), map_.sample());
    map_.sample().cells().resize(7);
    map_.write();
  };
  ASSERT_TRUE(neighbours_.until(
      [&] {
        return neighbours_.refused("target/state") >= 2 && neighbours_.refused("map/local") > 0;
      },
      send_garbage));
  EXPECT_TRUE(neighbours_.until([&] { return says(PredictionStatus::kOk); }, [&] { feed(); }));
}

}  // namespace
}  // namespace foretrack::testing
