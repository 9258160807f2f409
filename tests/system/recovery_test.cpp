// SPDX-License-Identifier: Apache-2.0
// Every service on the vehicle is killed in turn during one flight.
#include "services/launch/domain.hpp"
#include "services/launch/flight_processes.hpp"
#include "tests/system/program.hpp"

namespace foretrack {
namespace {

constexpr int kLinesAfter = 5;  // one a second

bool is_taken(const std::string& order, const std::string& domain, const Folder& folder) {
  Program program({"order", order, "--domain", domain}, folder.path / order);
  return program.wait(20.0) == 0;
}

// A gate that was killed resumes nothing unasked: it holds, or, if it was away for too long, has
// left the vehicle to the flight controller.
bool flies_on(const std::string& domain, const Folder& folder) {
  return eventually(
      [&] { return is_taken("resume", domain, folder) || is_taken("start", domain, folder); },
      20.0);
}

TEST(Recovery, TheVehicleFliesOnWithoutCollisionWhenAnyServiceIsKilled) {
  const FreeDomain domain;
  const std::string id = std::to_string(domain.id());
  Folder folder;
  const auto out = folder.path / "flight";
  Program demo({"demo", "--headless", "--for", "40", "--domain", id, "--out", out.string()},
               folder.path / "out");
  const auto tracks = [&] {
    const auto text = demo.output();
    const auto last = text.rfind("gate ");
    return last != std::string::npos && text.compare(last, 10, "gate track") == 0;
  };
  ASSERT_TRUE(eventually(tracks, 30.0)) << demo.output();
  for (const std::string service : kOnboardServices) {
    const auto before = processes_with({service, "--domain", id});
    ASSERT_EQ(before.size(), 1u) << service;
    kill(before[0], SIGKILL);
    ASSERT_TRUE(eventually(
        [&] {
          const auto now = processes_with({service, "--domain", id});
          return now.size() == 1 && now[0] != before[0];
        },
        5.0))
        << service << " was not started again";
    const auto length = demo.output().size();
    EXPECT_TRUE(service != "safety_gate" || flies_on(id, folder)) << demo.output();
    EXPECT_TRUE(eventually(
        [&] { return demo.output().find("gate track", length) != std::string::npos; }, 10.0))
        << "the loop did not go on after " << service << "\n"
        << demo.output();
  }
  const auto length = demo.output().size();
  EXPECT_TRUE(eventually(
      [&] { return std::ranges::count(demo.output().substr(length), '\n') >= kLinesAfter; }, 30.0));
  demo.send(SIGINT);
  ASSERT_NE(demo.wait(60.0), -1);
  const auto summary = Json::parse(text_of(out / "summary.json"));
  EXPECT_EQ(summary["metrics"]["collisions"], 0) << demo.output();
  EXPECT_EQ(summary["onboard"]["restarts"], 5);
}

}  // namespace
}  // namespace foretrack
