// SPDX-License-Identifier: Apache-2.0
#include "services/operator/diagnose.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>

namespace foretrack {
namespace {

using testing::HasSubstr;
namespace msg = foretrack_msgs::msg;

// A flight in which all is well, until a test breaks it.
struct Flight {
  Flight() {
    odometry.twist().twist().linear().x(1.0);
    target.status(msg::TargetState_Constants::STATUS_TRACKING);
    plan.status(msg::PlannedTrajectory_Constants::STATUS_FRESH);
    safety.mode(msg::SafetyState_Constants::MODE_TRACK);
    safety.phase(msg::SafetyState_Constants::PHASE_TRACKING);
    safety.armed(true);
    safety.offboard(true);
    snapshot.vehicle = "uav1";
    snapshot.domain = 7;
    snapshot.odometry = &odometry;
    snapshot.target = &target;
    snapshot.prediction = &prediction;
    snapshot.plan = &plan;
    snapshot.safety = &safety;
    for (const char* topic :
         {"odometry", "camera/color/image", "camera/color/camera_info", "camera/depth/image",
          "camera/depth/camera_info", "fmu/out/vehicle_status", "target/observation",
          "target/state", "map/local", "target/intention", "target/prediction", "plan/trajectory",
          "safety/state"})
      snapshot.flows.push_back({.topic = topic,
                                .wire = std::string("rt/uav1/") + topic,
                                .rate_hz = 20.0,
                                .age_s = 0.05,
                                .writers = 1,
                                .samples = 60,
                                .rejected = {},
                                .refusal = {}});
    for (const char* service : {"perception", "mapping"})
      snapshot.services.push_back(said(service));
    snapshot.px4_release = snapshot.px4_spoken = "1.16";
  }
  static ServiceReport said(const std::string& service, const std::string& words = "") {
    ServiceReport report;
    report.health.service(service);
    report.health.last_error(words);
    return report;
  }
  void says(std::string_view service, const std::string& words) {
    for (auto& report : snapshot.services)
      if (report.health.service().c_str() == service) {
        report.health.state(msg::ServiceHealth_Constants::STATE_DEGRADED);
        report.health.last_error(words);
      }
  }
  void lose(std::string_view service) {
    std::erase_if(snapshot.services, [&](const ServiceReport& report) {
      return report.health.service().c_str() == service;
    });
  }
  void refuse(std::string_view topic, const char* field, const std::string& words) {
    flow(topic).samples = 0;
    flow(topic).rejected = {{field, 12}};
    flow(topic).refusal = words;
  }
  std::string advice() const {
    const auto findings = diagnose(snapshot);
    const auto* first = first_cause(findings);
    return first ? first->advice : "";
  }
  TopicFlow& flow(std::string_view topic) { return const_cast<TopicFlow&>(*snapshot.flow(topic)); }
  void silence(std::string_view topic) {
    flow(topic).samples = 0;
    flow(topic).writers = 0;
    flow(topic).age_s = -1.0;
  }
  std::string cause() const {
    const auto findings = diagnose(snapshot);
    const auto* first = first_cause(findings);
    return first ? first->text : "";
  }

  nav_msgs::msg::Odometry odometry;
  msg::TargetState target;
  msg::TargetPrediction prediction;
  msg::PlannedTrajectory plan;
  msg::SafetyState safety;
  FlightSnapshot snapshot;
};

TEST(Diagnose, FindsNothingInAGoodFlight) {
  EXPECT_EQ(Flight().cause(), "");
}

TEST(Diagnose, NamesTheTopicAndTheServiceThatIsMissing) {
  constexpr std::array<std::array<const char*, 2>, 7> kWriters = {
      {{"target/observation", "perception"},
       {"target/state", "perception"},
       {"map/local", "mapping"},
       {"target/intention", "prediction"},
       {"target/prediction", "prediction"},
       {"plan/trajectory", "planning"},
       {"safety/state", "safety_gate"}}};
  for (const auto& [topic, service] : kWriters) {
    Flight flight;
    flight.silence(topic);
    flight.lose(service);
    EXPECT_THAT(flight.cause(), HasSubstr(std::string("rt/uav1/") + topic));
    EXPECT_THAT(flight.cause(), HasSubstr(std::string("service ") + service + " is missing"));
  }
}

TEST(Diagnose, GivesTheFirstCauseOfAChainOfFaults) {
  Flight flight;
  flight.silence("map/local");
  flight.silence("plan/trajectory");
  flight.safety.mode(msg::SafetyState_Constants::MODE_HOVER);
  flight.safety.reason(msg::SafetyState_Constants::REASON_NO_PLAN_YET);
  EXPECT_THAT(flight.cause(), HasSubstr("map/local"));
}

TEST(Diagnose, BlamesMissingDepthImagesForAMissingMap) {
  Flight flight;
  flight.silence("camera/depth/image");
  EXPECT_EQ(flight.cause(), "") << "a map that comes needs no depth images";
  flight.silence("map/local");
  EXPECT_THAT(flight.cause(), HasSubstr("camera/depth/image"));
}

TEST(Diagnose, LetsAKnownMapBeOld) {
  Flight flight;
  flight.flow("map/local").age_s = 100.0;
  EXPECT_THAT(flight.cause(), HasSubstr("stopped 100.0 s ago"));
  flight.snapshot.map_is_static = true;
  EXPECT_EQ(flight.cause(), "");
}

TEST(Diagnose, TellsAMismatchOfQualityFromAMissingWriter) {
  Flight flight;
  flight.silence("target/state");
  flight.flow("target/state").incompatible_qos = 1;
  EXPECT_THAT(flight.cause(), HasSubstr("quality of service"));
}

TEST(Diagnose, TellsAForeignTypeFromAMissingWriter) {
  Flight flight;
  flight.silence("target/state");
  flight.snapshot.foreign = {"a writer on rt/uav1/target/state will never match: its type is X."};
  EXPECT_THAT(flight.cause(), HasSubstr("its type is X"));
}

TEST(Diagnose, SaysWhyEverySampleWasRejected) {
  Flight flight;
  flight.flow("target/state").samples = 0;
  flight.flow("target/state").rejected = {{"stamp in the future", 12}};
  EXPECT_THAT(flight.cause(), HasSubstr("12 × stamp in the future"));
}

// What a driver or the flight controller must write: never the simulator's work.
TEST(Diagnose, NamesTheInputThatNobodyWritesAndHowToGiveIt) {
  for (const char* topic : {"odometry", "camera/color/image", "camera/color/camera_info",
                            "camera/depth/camera_info", "fmu/out/vehicle_status"}) {
    Flight flight;
    flight.silence(topic);
    if (std::string_view(topic) == "camera/color/image") flight.silence("target/observation");
    EXPECT_THAT(flight.cause(), HasSubstr(std::string("Nobody writes rt/uav1/") + topic));
    EXPECT_THAT(flight.advice(), HasSubstr("--remap"));
    EXPECT_THAT(to_text(diagnose(flight.snapshot)), Not(HasSubstr("foretrack up")));
    EXPECT_THAT(to_text(diagnose(flight.snapshot)), Not(HasSubstr("simulator")));
  }
  Flight simulated;
  simulated.snapshot.simulated = true;
  simulated.silence("odometry");
  EXPECT_THAT(simulated.advice(), HasSubstr("foretrack up"));
}

TEST(Diagnose, NamesTopicsOfTheSameTypeAndPresetsThatFit) {
  Flight flight;
  flight.silence("odometry");
  flight.snapshot.published = {{"rt/mavros/local_position/odom", "nav_msgs::msg::dds_::Odometry_"},
                               {"rt/uav1/simulator/vehicle", "nav_msgs::msg::dds_::Odometry_"},
                               {"rt/camera/image_raw", "sensor_msgs::msg::dds_::Image_"}};
  EXPECT_THAT(flight.advice(), HasSubstr("--remap odometry:=mavros/local_position/odom takes it"));
  EXPECT_THAT(flight.advice(), Not(HasSubstr("simulator")));
  flight.snapshot.fitting_presets = {"mavros"};
  EXPECT_THAT(to_text(diagnose(flight.snapshot)), HasSubstr("these presets: mavros"));
}

TEST(Diagnose, ShowsValueAndExpectationOfWhatIsRefused) {
  Flight flight;
  flight.refuse("odometry", "child_frame_id", "child_frame_id is 'fcu', expected 'base_link'");
  EXPECT_THAT(flight.cause(),
              HasSubstr("12 × child_frame_id: child_frame_id is 'fcu', expected 'base_link'"));
  Flight some;
  some.flow("odometry").refusal = "twist.linear is nan";
  EXPECT_EQ(some.cause(), "");
  EXPECT_THAT(to_text(diagnose(some.snapshot)),
              HasSubstr("some samples are refused: twist.linear"));
}

TEST(Diagnose, TellsAStuckDriverFromAMissingOne) {
  Flight flight;
  flight.flow("camera/depth/image").samples = 0;
  flight.silence("map/local");
  EXPECT_THAT(flight.cause(), HasSubstr("has a writer, but nothing comes: the depth image"));
  Flight stopped;
  stopped.flow("odometry").age_s = 3.0;
  stopped.flow("odometry").writers = 0;
  EXPECT_THAT(stopped.cause(), HasSubstr("stopped 3.0 s ago. Its writer is gone."));
}

TEST(Diagnose, SaysThatNobodyKnowsWhereACameraSits) {
  Flight flight;
  flight.says("mapping",
              "where the camera 'camera_depth_optical_frame' sits is not known (no "
              "transform of 'camera_depth_optical_frame' is known)");
  EXPECT_THAT(flight.cause(), HasSubstr("mapping: where the camera 'camera_depth_optical_frame'"));
  EXPECT_THAT(flight.advice(), HasSubstr("--depth-mount"));
}

TEST(Diagnose, SaysThatTheNetworksAreMissingOrNobodyIsInTheImages) {
  Flight flight;
  flight.says("perception", "pose_landmark.tflite is missing; ./run models fetches it");
  EXPECT_THAT(flight.cause(), HasSubstr("The networks cannot be loaded"));
  Flight empty;
  empty.snapshot.nobody_in_images = true;
  EXPECT_EQ(empty.cause(), "");
  EXPECT_THAT(to_text(diagnose(empty.snapshot)), HasSubstr("nobody is found in them"));
}

TEST(Diagnose, ObservationsFromElsewhereNeedNoColourImages) {
  Flight flight;
  flight.silence("camera/color/image");
  flight.silence("camera/color/camera_info");
  EXPECT_EQ(flight.cause(), "");
  EXPECT_THAT(to_text(diagnose(flight.snapshot)), HasSubstr("observations come from elsewhere"));
}

TEST(Diagnose, SaysWhichReleaseTheFlightControllerSpeaks) {
  Flight flight;
  flight.silence("fmu/out/vehicle_status");
  flight.snapshot.px4_spoken = "1.17";
  EXPECT_THAT(flight.cause(), HasSubstr("speaks as PX4 1.17 does; 1.16 is expected"));
  EXPECT_THAT(flight.advice(), HasSubstr("--px4 1.17"));
}

TEST(Diagnose, SaysThatTheFlightControllerHasAnotherNamespace) {
  Flight flight;
  flight.silence("fmu/out/vehicle_status");
  flight.snapshot.published = {{"rt/px4_2/fmu/out/vehicle_status_v1", "px4"}};
  EXPECT_THAT(flight.advice(), HasSubstr("--px4-namespace px4_2"));
}

TEST(Diagnose, SaysThatTheFlightControllersStampsAreOfAnotherClock) {
  Flight flight;
  flight.snapshot.px4_ahead_s = -1.7e9;
  EXPECT_THAT(flight.cause(), HasSubstr("not in this machine's time"));
  EXPECT_THAT(flight.advice(), HasSubstr("UXRCE_DDS_SYNCT"));
}

TEST(Diagnose, SaysInPlainWordsWhyThereIsNoPlan) {
  Flight flight;
  flight.plan.status(msg::PlannedTrajectory_Constants::STATUS_HOLD);
  flight.plan.reason(msg::PlannedTrajectory_Constants::REASON_EMPTY_CORRIDOR);
  EXPECT_THAT(flight.cause(), HasSubstr("the free space along the way is too tight"));
}

TEST(Diagnose, SaysThatTheAutopilotIsNotArmedOrNotOffboard) {
  Flight flight;
  flight.safety.offboard(false);
  EXPECT_THAT(flight.cause(), HasSubstr("not in offboard mode"));
  flight.safety.armed(false);
  EXPECT_THAT(flight.cause(), HasSubstr("not armed"));
}

TEST(Diagnose, NoticesAClockThatDiffers) {
  Flight flight;
  ServiceReport report;
  report.health.service("planning");
  report.clock_ahead_s = -2.0;
  flight.snapshot.services.push_back(report);
  EXPECT_THAT(flight.cause(), HasSubstr("clock of planning is -2.0 s off"));
}

TEST(Diagnose, SaysHowFarTheClocksDiffer) {
  Flight flight;
  flight.snapshot.services[0].clock_ahead_s = -0.012;
  EXPECT_THAT(to_text(diagnose(flight.snapshot)), HasSubstr("differ by -0.012 s at most"));
  EXPECT_EQ(first_cause(diagnose(flight.snapshot)), nullptr);
}

TEST(Diagnose, NamesAPeerOfAnotherVersion) {
  Flight flight;
  flight.snapshot.other_versions = {"uav1/planning on rt/uav1/target/state: TargetState_ is of …"};
  const auto findings = diagnose(flight.snapshot);
  ASSERT_TRUE(first_cause(findings));
  EXPECT_THAT(first_cause(findings)->text, HasSubstr("uav1/planning on rt/uav1/target/state"));
  EXPECT_THAT(first_cause(findings)->advice, HasSubstr("same version"));
}

TEST(Diagnose, NamesTwoSimulatorsOnOneClock) {
  Flight flight;
  flight.snapshot.clocks = 2;
  const auto findings = diagnose(flight.snapshot);
  ASSERT_TRUE(first_cause(findings));
  EXPECT_THAT(first_cause(findings)->text, HasSubstr("2 simulators write one clock"));
}

TEST(Diagnose, SaysOneThingWhenNobodyIsThere) {
  Flight flight;
  for (auto& flow : flight.snapshot.flows) flight.silence(flow.topic);
  flight.snapshot.services.clear();
  flight.snapshot.other_vehicles = {"kestrel"};
  const auto findings = diagnose(flight.snapshot);
  ASSERT_EQ(findings.size(), 1u);
  EXPECT_THAT(findings[0].text, HasSubstr("'uav1' is heard on DDS domain 7"));
  EXPECT_THAT(findings[0].advice, HasSubstr("kestrel"));
  flight.snapshot.other_vehicles.clear();
  EXPECT_THAT(diagnose(flight.snapshot)[0].advice, HasSubstr("on this network"));
  flight.snapshot.this_machine_only = true;
  EXPECT_THAT(diagnose(flight.snapshot)[0].advice, HasSubstr("--interface"));
}

TEST(Diagnose, SaysWhoCanBeHeard) {
  Flight flight;
  EXPECT_THAT(to_text(diagnose(flight.snapshot)), Not(HasSubstr("--interface")));
  flight.snapshot.this_machine_only = true;
  EXPECT_THAT(to_text(diagnose(flight.snapshot)), HasSubstr("Only this machine is heard"));
  flight.snapshot.this_machine_only = false;
  flight.snapshot.unsecured = "DDS is not secured";
  EXPECT_THAT(to_text(diagnose(flight.snapshot)), HasSubstr("not secured"));
}

}  // namespace
}  // namespace foretrack
