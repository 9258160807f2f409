// SPDX-License-Identifier: Apache-2.0
// The stages speak with a participant of another vendor, built from the same IDL files.
#include <algorithm>
#include <cstdlib>
#include <string>
#include <vector>

#include "services/launch/domain.hpp"
#include "tests/system/program.hpp"

namespace foretrack {
namespace {

TEST(Cyclone, HearsEveryStageOfAFlight) {
  const FreeDomain domain;
  const std::string id = std::to_string(domain.id());
  Folder folder;
  Program up({"up", "--domain", id, "--out", folder.path.string()}, folder.path / "up");
  Program peer({id, "uav1", "40", "listen"}, folder.path / "peer", INTEROP_PEER);
  EXPECT_EQ(peer.wait(50.0), 0) << peer.output();
  const auto heard = Json::parse(peer.output());
  EXPECT_EQ(heard["insane"], 0) << peer.output();
  for (const char* topic : {"states", "intentions", "predictions", "plans"})
    EXPECT_GE(heard[topic], 10) << topic;
}

// As two nodes of ROS 2 are: on the well-known ports, with one multicast address for both.
TEST(Cyclone, TwoPeersThatShareAMulticastAddressHearAFlightThatGoesOn) {
  const FreeDomain domain;
  const std::string id = std::to_string(domain.id());
  Folder folder;
  Program up({"up", "--domain", id, "--out", folder.path.string()}, folder.path / "up");
  setenv("CYCLONEDDS_URI", "<Discovery><ParticipantIndex>auto</ParticipantIndex></Discovery>", 1);
  Program one({id, "uav1", "40", "listen"}, folder.path / "one", INTEROP_PEER);
  Program two({id, "uav1", "40", "listen"}, folder.path / "two", INTEROP_PEER);
  unsetenv("CYCLONEDDS_URI");
  EXPECT_EQ(one.wait(50.0), 0) << one.output();
  EXPECT_EQ(two.wait(50.0), 0) << two.output();
  EXPECT_EQ(up.output().find("was killed"), std::string::npos) << up.output();
}

TEST(Cyclone, TellsPerceptionWhereThePersonIs) {
  const FreeDomain domain;
  const std::string id = std::to_string(domain.id());
  Folder folder;
  Program perception({"perception", "--domain", id}, folder.path / "perception");
  Program peer({id, "uav1", "20", "observe", "3.5", "-1.25", "1.2"}, folder.path / "peer",
               INTEROP_PEER);
  EXPECT_EQ(peer.wait(30.0), 0) << peer.output() << text_of(folder.path / "perception");
  const auto heard = Json::parse(peer.output());
  EXPECT_NEAR(heard["position_m"][0], 3.5, 0.3);
  EXPECT_NEAR(heard["position_m"][1], -1.25, 0.3);
  EXPECT_NEAR(heard["position_m"][2], 1.2, 0.3);
}

// What the doctor says first, of a bus on which the vehicle's sensors and camera are well.
std::string doctor_beside(const std::string& peer_mode) {
  const FreeDomain domain;
  const std::string id = std::to_string(domain.id());
  Folder folder;
  Program simulator({"simulator", "--domain", id, "--map", "depth", "--endless", "--speed", "0.2"},
                    folder.path / "simulator");
  Program peer({id, "uav1", "60", peer_mode}, folder.path / "peer", INTEROP_PEER);
  Program doctor({"doctor", "--domain", id, "--json", "--for", "4"}, folder.path / "doctor");
  doctor.wait(30.0);
  const auto said = Json::parse(doctor.output());
  return said["first_cause"].is_string() ? said["first_cause"].get<std::string>() : "";
}

TEST(Cyclone, DoctorNamesAQualityOfServiceThatDoesNotFit) {
  const std::string cause = doctor_beside("unreliable");
  EXPECT_NE(cause.find("rt/uav1/target/state is there, but its quality"), std::string::npos)
      << cause;
}

TEST(Cyclone, DoctorNamesAForeignType) {
  const std::string cause = doctor_beside("foreign");
  EXPECT_NE(cause.find("a writer on rt/uav1/target/state will never match"), std::string::npos)
      << cause;
  EXPECT_NE(cause.find("TargetIntention_"), std::string::npos) << cause;
}

// As `ros2 param list` does on rmw_cyclonedds.
TEST(Cyclone, AsksANodeForItsParametersAndHearsTheHashOfItsTypes) {
  const FreeDomain domain;
  const std::string id = std::to_string(domain.id());
  Folder folder;
  Program gate({"safety_gate", "--domain", id, "--state-dir", folder.path.string()},
               folder.path / "gate");
  Program asker({id, "uav1/safety_gate", "30"}, folder.path / "asker", INTEROP_ASKER);
  EXPECT_EQ(asker.wait(40.0), 0) << asker.output() << text_of(folder.path / "gate");
  const auto heard = Json::parse(asker.output());
  const auto names = heard["names"].get<std::vector<std::string>>();
  for (const char* name : {"use_sim_time", "safety.plan_fresh_s"})
    EXPECT_NE(std::find(names.begin(), names.end(), name), names.end()) << name;
  EXPECT_EQ(heard["told"].get<std::string>().find("typehash=RIHS01_"), 0u) << heard["told"];
}

TEST(Cyclone, DoctorTellsWhatPerceptionRejects) {
  const FreeDomain domain;
  const std::string id = std::to_string(domain.id());
  Folder folder;
  Program perception({"perception", "--domain", id}, folder.path / "perception");
  Program peer({id, "uav1", "60", "observe", "nan", "0", "0"}, folder.path / "peer", INTEROP_PEER);
  std::string said;
  EXPECT_TRUE(eventually(
      [&] {
        Program doctor({"doctor", "--domain", id}, folder.path / "doctor");
        doctor.wait(30.0);
        said = doctor.output();
        return said.find("perception rejected samples of rt/uav1/target/observation") !=
               std::string::npos;
      },
      20.0))
      << said;
}

}  // namespace
}  // namespace foretrack
