// The stages speak with a participant of another vendor, built from the same IDL files.
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

}  // namespace
}  // namespace foretrack
