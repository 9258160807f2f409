// SPDX-License-Identifier: Apache-2.0
// When a silence calls for joining the bus anew, and when not.
#include "services/ground_station/bus/hearing.hpp"

#include <gtest/gtest.h>

namespace foretrack::station {
namespace {

constexpr double kLease_s = 20.0;
const PeerId kId = {1, 2, 3};

/// Discovered at 0, heard each second from 1 to the end.
struct Peers {
  explicit Peers(int last_s, double period_s = 1.0) {
    for (double t = 1.0; t <= last_s; t += period_s) hearing.heard(kId, t);
  }
  std::string at(double now_s) { return hearing.complaint(peers, now_s); }

  Hearing hearing;
  std::vector<Peer> peers = {{kId, "uav1/planning", kLease_s, 0.0}};
};

TEST(Hearing, MissesWhoOutlivesItsLeaseInSilence) {
  Peers p(30);
  EXPECT_EQ(p.at(51.0), "");  // it may have ended
  EXPECT_EQ(p.at(52.5), "uav1/planning lives, but nothing was heard of it for 22.5 s");
}

TEST(Hearing, MissesWhoComesBackAndStaysSilent) {
  Peers p(30);
  p.peers[0].since_s = 60.0;
  EXPECT_EQ(p.at(64.0), "") << "it needs a moment";
  EXPECT_EQ(p.at(66.0), "uav1/planning is back, but nothing was heard of it for 36.0 s");
  p.hearing.heard(kId, 66.1);
  EXPECT_EQ(p.at(80.0), "");
}

TEST(Hearing, DoesNotMissTheDead) {
  Peers p(30);
  p.peers.clear();  // dropped
  EXPECT_EQ(p.at(100.0), "");
}

TEST(Hearing, DoesNotMissWhoSeldomSpeaks) {
  EXPECT_EQ(Peers(100, 5.0).at(200.0), "");
  EXPECT_EQ(Peers(3).at(200.0), "") << "too short to know";
  Peers strangers(30);
  strangers.peers[0].id = {9};
  EXPECT_EQ(strangers.at(200.0), "");
}

TEST(Hearing, ComplainsOnceOfASilence) {
  Peers p(30);
  EXPECT_NE(p.at(60.0), "");
  p.hearing.reset();
  EXPECT_EQ(p.at(200.0), "");
}

}  // namespace
}  // namespace foretrack::station
