// SPDX-License-Identifier: Apache-2.0
#include "services/onboard/perception/perception_service.hpp"

#include "core/common/random.hpp"
#include "core/simulator/landmark_camera.hpp"
#include "services/convert/bodies.hpp"
#include "services/convert/choice.hpp"
#include "services/convert/image.hpp"
#include "services/convert/safety.hpp"
#include "services/convert/target.hpp"
#include "tests/services/onboard/neighbours.hpp"

namespace foretrack::testing {
namespace {

class PerceptionOnDds : public ::testing::Test {
 protected:
  PerceptionOnDds() { neighbours_.vehicle.position_enu_m = {0.0, 0.0, 1.5}; }

  TargetObservation position_at(double stamp_s) const {
    TargetObservation o;
    o.stamp_s = stamp_s;
    o.kind = TargetObservation::Kind::kPosition;
    o.position_enu_m = {3.0, 0.5, 1.0};
    o.covariance_m2 = Mat3::Identity() * 0.01;
    return o;
  }
  // As the camera of a vehicle at rest sees a person 3 m ahead.
  TargetObservation landmarks_at(double stamp_s) const {
    LandmarkCameraParams params;
    params.delay_s = 0.0;
    LandmarkCamera camera = make_landmark_camera(params, 1);
    PersonState person;
    person.stamp_s = stamp_s;
    person.position_enu_m = {3.0, 0.0, 1.0};
    VehicleState vehicle = neighbours_.vehicle;
    vehicle.stamp_s = stamp_s;
    return observe(camera, World{}, vehicle, person, 1.75).value();
  }
  void send(const TargetObservation& observation) {
    to_idl(observation, observation_.sample());
    observation_.write();
  }
  void feed(double delay_s = 0.0) {
    neighbours_.send_odometry();
    send(position_at(neighbours_.now_s() - delay_s));
  }
  // Takes what came; true if the newest state has the status.
  bool says(TrackStatus status) {
    target_.take_each([this](const auto& message) {
      const auto state = from_idl(message);
      ASSERT_TRUE(state) << state.fault().text;
      went_back_ |= state->stamp_s < newest_.stamp_s - 1e-9 && newest_.usable();
      newest_ = *state;
      ++heard_;
    });
    return heard_ > 0 && newest_.status == status;
  }

  Neighbours neighbours_;
  Writer<topics::TargetObservation> observation_{neighbours_.node()};
  Reader<topics::TargetState> target_{neighbours_.node()};
  Running service_{[](const ServiceOptions& options, Stop& stop) {
    run_perception(options, PerceptionParams{}, BodyParams{}, ChoiceParams{}, StreamParams{}, stop);
  }};
  TargetState newest_;
  int heard_ = 0;
  bool went_back_ = false;
};

TEST_F(PerceptionOnDds, SaysThatItHasNeverSeenTheTarget) {
  EXPECT_TRUE(neighbours_.until([&] { return says(TrackStatus::kNone); }));
}

TEST_F(PerceptionOnDds, SaysWithTheBodiesWhenColourImagesAreFrozenDarkOrCovered) {
  namespace b = foretrack_msgs::msg::MovingBodies_Constants;
  Writer<topics::ColorImage> images(neighbours_.node());
  Reader<topics::MovingBodies> bodies(neighbours_.node());
  Random random(1);
  std::uint8_t said = b::CAMERA_SEES;
  double x_m = 0.0;
  const auto says_of = [&](const std::function<std::uint8_t()>& pixel, std::uint8_t wanted,
                           bool new_pixels = true) {
    RgbImage image;
    image.width_px = 64;
    image.height_px = 48;
    image.rgb.resize(64 * 48 * 3);
    std::ranges::generate(image.rgb, pixel);
    return neighbours_.until(
        [&] {
          bodies.take_each([&](const auto& message) { said = message.camera(); });
          return said == wanted;
        },
        [&] {
          neighbours_.vehicle.position_enu_m.x() = x_m += 0.05;
          feed();
          if (new_pixels) std::ranges::generate(image.rgb, pixel);
          to_idl(image, neighbours_.now_s(), images.sample());
          images.write();
        });
  };
  const auto scene = [&] { return static_cast<std::uint8_t>(random.integer(40, 200)); };
  const auto night = [&] { return static_cast<std::uint8_t>(random.integer(0, 4)); };
  const auto hand = [&] { return static_cast<std::uint8_t>(random.integer(99, 101)); };
  EXPECT_TRUE(says_of(scene, b::CAMERA_FROZEN, false));
  EXPECT_TRUE(says_of(scene, b::CAMERA_SEES));
  EXPECT_TRUE(says_of(night, b::CAMERA_DARK));
  EXPECT_TRUE(says_of(hand, b::CAMERA_COVERED));
  EXPECT_TRUE(says_of(scene, b::CAMERA_SEES));
}

TEST_F(PerceptionOnDds, TracksWhatIsObserved) {
  ASSERT_TRUE(neighbours_.until([&] { return says(TrackStatus::kTracking); }, [&] { feed(); }));
  EXPECT_LT((newest_.position_enu_m - Vec3(3.0, 0.5, 1.0)).norm(), 0.2);
}

TEST_F(PerceptionOnDds, CoastsAndThenLosesATargetWithoutEverGoingBackInTime) {
  ASSERT_TRUE(neighbours_.until([&] { return says(TrackStatus::kTracking); }, [&] { feed(0.05); }));
  ASSERT_TRUE(neighbours_.until([&] { return says(TrackStatus::kCoasting); }));
  ASSERT_TRUE(neighbours_.until([&] { return says(TrackStatus::kTracking); }, [&] { feed(0.05); }));
  ASSERT_TRUE(neighbours_.until([&] { return says(TrackStatus::kLost); }));
  EXPECT_FALSE(went_back_);
}

TEST_F(PerceptionOnDds, WaitsForTheOdometryOfAnImage) {
  ASSERT_TRUE(neighbours_.until([&] { return says(TrackStatus::kNone); },
                                [&] { neighbours_.send_odometry(); }));
  // Each image is sent before the odometry of its stamp.
  ASSERT_TRUE(neighbours_.until([&] { return says(TrackStatus::kTracking); },
                                [&] {
                                  send(landmarks_at(neighbours_.now_s()));
                                  neighbours_.send_odometry();
                                }));
  EXPECT_LT((newest_.position_enu_m - Vec3(3.0, 0.0, 1.0)).norm(), 0.5);
}

TEST_F(PerceptionOnDds, JoinsWhoIsSeenAroundWithThePersonWhoIsFollowed) {
  Writer<topics::BodySightings> sightings(neighbours_.node());
  Reader<topics::MovingBodies> reader(neighbours_.node());
  const auto feed_both = [&] {
    feed();
    BodySightings seen;
    seen.stamp_s = neighbours_.now_s();
    seen.add({BodyKind::kPerson, {4.0, -2.0, 0.0}, 0.01 * Mat2::Identity(), 0.25, 1.6});
    to_idl(seen, sightings.sample());
    sightings.write();
  };
  MovingBodies bodies;
  const auto hears_two = [&] {
    const auto* message = reader.take_newest();
    if (!message) return false;
    const auto converted = from_idl(*message);
    EXPECT_TRUE(converted) << converted.fault().text;
    bodies = *converted;
    return bodies.count == 2;
  };
  ASSERT_TRUE(neighbours_.until(hears_two, feed_both));
  const MovingBody &person = bodies.bodies[0], &other = bodies.bodies[1];
  EXPECT_TRUE(person.followed);
  EXPECT_LT((person.position_enu_m - Vec3(3.0, 0.5, 1.0 - kTorsoShare * 1.75)).norm(), 0.2);
  EXPECT_FALSE(other.followed);
  EXPECT_LT((other.position_enu_m - Vec3(4.0, -2.0, 0.0)).norm(), 0.2);
  EXPECT_NE(person.id, other.id);
}

TEST_F(PerceptionOnDds, RefusesGarbageAndGoesOn) {
  const auto send_garbage = [&] {
    auto& message = observation_.sample();
    to_idl(position_at(neighbours_.now_s()), message);
    message.position_m()[0] = kNaN;
    observation_.write();
    to_idl(landmarks_at(neighbours_.now_s()), message);
    message.landmarks().resize(500);
    observation_.write();
    message.kind(77);
    observation_.write();
    message = {};
    observation_.write();
    send(position_at(neighbours_.now_s() + 100.0));
    neighbours_.odometry().sample().pose().pose().orientation() = {};
    neighbours_.odometry().write();
  };
  ASSERT_TRUE(neighbours_.until(
      [&] {
        return neighbours_.refused("target/observation") >= 5 &&
               neighbours_.refused("odometry") > 0;
      },
      send_garbage));
  ASSERT_TRUE(neighbours_.until([&] { return says(TrackStatus::kTracking); }, [&] { feed(); }));
}

// Ada is observed at (3, 0.5), Bob is sighted by a detector at (4, -2); a gate says what was
// ordered.
class ChoiceOnDds : public PerceptionOnDds {
 protected:
  void feed_both() {
    feed();
    BodySightings seen;
    seen.stamp_s = neighbours_.now_s();
    seen.add({BodyKind::kPerson, {4.0, -2.0, 0.0}, 0.01 * Mat2::Identity()});
    to_idl(seen, sightings_.sample());
    sightings_.write();
    gate_.stamp_s = neighbours_.now_s();
    to_idl(gate_, gate_writer_.sample());
    gate_writer_.write();
  }
  void order(std::uint32_t person) {
    gate_.order = MissionOrder::kFollow;
    gate_.result.command_result = MissionResult::kAccepted;
    ++gate_.result.command_id;
    gate_.result.person = {true, person};
  }
  bool until_it(const std::function<bool()>& condition) {
    return neighbours_.until(
        [&] {
          says(TrackStatus::kNone);
          choice_reader_.take_each([this](const auto& message) {
            const auto report = from_idl(message);
            ASSERT_TRUE(report) << report.fault().text;
            choice_ = report->choice;
            ++choices_;
          });
          bodies_reader_.take_each([this](const auto& message) { bodies_ = *from_idl(message); });
          return condition();
        },
        [&] { feed_both(); });
  }
  std::uint32_t number_near(const Vec2& place_m) const {
    for (const MovingBody& body : bodies_.all())
      if ((body.position_enu_m.head<2>() - place_m).norm() < 0.5) return body.id;
    return 0;
  }
  bool follows(ChoiceStatus status, std::uint32_t person) const {
    return choice_.status == status && choice_.person_id == person;
  }

  Writer<topics::BodySightings> sightings_{neighbours_.node()};
  Writer<topics::SafetyState> gate_writer_{neighbours_.node()};
  Reader<topics::TargetChoice> choice_reader_{neighbours_.node()};
  Reader<topics::MovingBodies> bodies_reader_{neighbours_.node()};
  GateReport gate_;
  ChoiceResult choice_;
  MovingBodies bodies_;
  int choices_ = 0;
};

TEST_F(ChoiceOnDds, FollowsWhomTheGateWasToldToAndTellsIt) {
  const Vec2 ada_m(3.0, 0.5), bob_m(4.0, -2.0);
  ASSERT_TRUE(until_it([&] { return number_near(ada_m) != 0 && number_near(bob_m) != 0; }));
  const std::uint32_t ada = number_near(ada_m), bob = number_near(bob_m);
  ASSERT_TRUE(until_it([&] { return follows(ChoiceStatus::kFollowing, ada); }));
  order(bob);
  ASSERT_TRUE(until_it([&] { return follows(ChoiceStatus::kFollowing, bob); }));
  ASSERT_TRUE(until_it(
      [&] { return (newest_.position_enu_m.head<2>() - bob_m).norm() < 0.3 && newest_.usable(); }));
  EXPECT_EQ(number_near(ada_m), ada) << "she keeps her number";
  const int before = choices_;
  const double begin_s = neighbours_.now_s();
  ASSERT_TRUE(until_it([&] { return neighbours_.now_s() - begin_s > 1.0; }));
  EXPECT_GE(choices_ - before, 3) << "five times a second";
  EXPECT_LE(choices_ - before, 7);
  order(0);
  ASSERT_TRUE(until_it([&] { return follows(ChoiceStatus::kWaiting, 0); }));
  EXPECT_TRUE(until_it([&] { return newest_.status == TrackStatus::kNone; }));
  order(ada);
  EXPECT_TRUE(until_it([&] { return follows(ChoiceStatus::kFollowing, ada); }));
}

TEST_F(ChoiceOnDds, WhatTheGateRemembersOfBeforeMeansNothingToANewPerception) {
  gate_.order = MissionOrder::kLease;
  gate_.result.person = {true, 2};
  ASSERT_TRUE(until_it([&] { return choice_.status == ChoiceStatus::kFollowing; }));
  const double begin_s = neighbours_.now_s();
  ASSERT_TRUE(until_it([&] { return neighbours_.now_s() - begin_s > 1.0; }));
  EXPECT_LT((newest_.position_enu_m.head<2>() - Vec2(3.0, 0.5)).norm(), 0.3)
      << "numbers are given anew";
}

}  // namespace
}  // namespace foretrack::testing
