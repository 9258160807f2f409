// SPDX-License-Identifier: Apache-2.0
// Every service on the vehicle is paused in turn during one flight, as a machine does that is out
// of memory, and goes on later, with what it had in its hands.
#include "services/launch/domain.hpp"
#include "services/launch/flight_processes.hpp"
#include "tests/system/program.hpp"

namespace foretrack {
namespace {

constexpr int kLinesPaused = 5;  // of the flight's words, one a second

// Somebody who walks slowly, so that they are still near after a pause.
constexpr char kStroll[] =
    "world:\n  generator: {kind: empty}\ntarget:\n  speed_m_s: 0.3\nduration_s: 600\nseed: 1\n";

/// A flight whose words are read.
class Paused : public ::testing::Test {
 protected:
  std::string id() const { return std::to_string(domain_.id()); }
  /// The gate's mode in the last word.
  std::string mode() {
    const auto text = demo_.output();
    const auto last = text.rfind("gate ");
    return last == std::string::npos ? ""
                                     : text.substr(last + 5, text.find(' ', last + 5) - last - 5);
  }
  bool tracks() { return mode().starts_with("track"); }
  bool stops_tracking() {
    return eventually([&] { return !tracks(); }, 30.0);
  }
  bool lines_go_by(int count) {
    const auto length = demo_.output().size();
    return eventually(
        [&] { return std::ranges::count(demo_.output().substr(length), '\n') >= count; }, 60.0);
  }
  bool is_taken(const std::string& order) {
    Program program({"order", order, "--domain", id()}, folder_.path / order);
    return program.wait(20.0) == 0;
  }
  bool flies_on() {
    return eventually(
        [&] {
          if (!tracks() && !is_taken("resume")) is_taken("start");
          return eventually([&] { return tracks(); }, 5.0);
        },
        60.0);
  }

  const FreeDomain domain_;
  Folder folder_;
  std::filesystem::path out_ = folder_.path / "flight";
  std::string stroll() const {
    const auto file = folder_.path / "stroll.yaml";
    std::ofstream(file) << kStroll;
    return file.string();
  }
  Program demo_{{"demo", "--headless", "--scenario", stroll(), "--for", "240", "--domain", id(),
                 "--out", out_.string()},
                folder_.path / "out"};
};

TEST_F(Paused, NoServiceHarmsTheFlightByBeingPausedAndTheLoopGoesOnAfterIt) {
  ASSERT_TRUE(eventually([&] { return tracks(); }, 60.0)) << demo_.output();
  for (const std::string service : kOnboardServices) {
    const auto pids = processes_with({service, "--domain", id()});
    ASSERT_EQ(pids.size(), 1u) << service;
    kill(pids[0], SIGSTOP);
    EXPECT_TRUE(lines_go_by(kLinesPaused)) << demo_.output();
    // Without a map or plans nothing is followed. A gate that was away says so when it is back, as
    // the flight controller has the vehicle. The others may be missed for a while.
    const bool is_gate = service == "safety_gate";
    const bool is_missed = service == "mapping" || service == "planning";
    EXPECT_TRUE(!is_missed || stops_tracking()) << service << "\n" << demo_.output();
    kill(pids[0], SIGCONT);
    EXPECT_TRUE(!is_gate || stops_tracking()) << service << "\n" << demo_.output();
    EXPECT_TRUE(flies_on()) << "after " << service << "\n" << demo_.output();
    EXPECT_EQ(processes_with({service, "--domain", id()}), pids) << service << " was not killed";
  }
  demo_.send(SIGINT);
  ASSERT_NE(demo_.wait(60.0), -1);
  const auto summary = Json::parse(text_of(out_ / "summary.json"));
  EXPECT_EQ(summary["metrics"]["collisions"], 0) << demo_.output();
  EXPECT_EQ(summary["onboard"]["restarts"], 0);
}

}  // namespace
}  // namespace foretrack
