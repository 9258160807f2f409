// SPDX-License-Identifier: Apache-2.0
#include "services/launch/launcher.hpp"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>
#include <functional>
#include <thread>

namespace foretrack {
namespace {

using namespace std::chrono_literals;

struct Folder {
  Folder() {
    char name[] = "/tmp/foretrack-test-XXXXXX";
    path = mkdtemp(name);
  }
  ~Folder() { std::filesystem::remove_all(path); }
  std::filesystem::path path;
};

ProcessSpec shell(const std::string& script) {
  return {"shell", {"-c", script}};
}

bool eventually(const std::function<bool()>& condition) {
  const auto end = std::chrono::steady_clock::now() + 5s;
  while (!condition()) {
    if (std::chrono::steady_clock::now() > end) return false;
    std::this_thread::sleep_for(2ms);
  }
  return true;
}

TEST(Launcher, StartsAKilledProcessAgainAndSaysSo) {
  Folder folder;
  Launcher launcher(folder.path, "/bin/sh");
  launcher.add(shell("exec sleep 60"));
  launcher.poll();
  const pid_t first = launcher.processes()[0].pid;
  kill(first, SIGKILL);
  std::string said;
  ASSERT_TRUE(eventually([&] {
    for (const auto& line : launcher.poll()) said += line + "\n";
    return launcher.processes()[0].starts == 2;
  }));
  EXPECT_NE(launcher.processes()[0].pid, first);
  EXPECT_EQ(launcher.restarts(), 1);
  EXPECT_NE(said.find("was killed by KILL"), std::string::npos) << said;
  EXPECT_NE(said.find("started again"), std::string::npos) << said;
}

TEST(Launcher, StartsAnewAtOnceAfterTheFirstCrash) {
  Folder folder;
  Launcher launcher(folder.path, "/bin/sh");
  launcher.add(shell("exec sleep 60"));
  launcher.poll();
  kill(launcher.processes()[0].pid, SIGKILL);
  ASSERT_TRUE(eventually([&] {
    launcher.poll();
    return launcher.processes()[0].crashes_in_a_row == 1;
  }));
  EXPECT_LE(launcher.processes()[0].due, std::chrono::steady_clock::now());
}

TEST(Launcher, StartsAlsoWhatEndedWellIfItIsToRunAlways) {
  Folder folder;
  Launcher launcher(folder.path, "/bin/sh");
  ProcessSpec brief = shell("exit 0");
  brief.always = true;
  launcher.add(brief);
  EXPECT_TRUE(eventually([&] {
    launcher.poll();
    return launcher.processes()[0].starts == 2;
  }));
  EXPECT_FALSE(launcher.any_given_up());
}

TEST(Launcher, WaitsLongerAfterEachCrash) {
  Folder folder;
  Launcher launcher(folder.path, "/bin/sh");
  launcher.add(shell("exit 1"));
  std::vector<std::chrono::steady_clock::duration> waits;
  ASSERT_TRUE(eventually([&] {
    const bool ran = !launcher.processes().empty() && launcher.processes()[0].pid > 0;
    launcher.poll();
    const auto& p = launcher.processes()[0];
    if (ran && p.pid < 0) waits.push_back(p.due - p.started);
    return waits.size() == 4;
  }));
  EXPECT_GE(waits[3], waits[0] + 500ms);
}

TEST(Launcher, GivesUpOnAProcessThatRefusesItsArguments) {
  Folder folder;
  Launcher launcher(folder.path, "/bin/sh");
  launcher.add(shell("echo no such parameter; exit 2"));
  std::string said;
  ASSERT_TRUE(eventually([&] {
    for (const auto& line : launcher.poll()) said += line + "\n";
    return launcher.processes()[0].given_up;
  }));
  EXPECT_NE(said.find("no such parameter"), std::string::npos) << said;
  launcher.poll();
  EXPECT_EQ(launcher.processes()[0].starts, 1);
}

// In flight, an interface may be gone at the moment of a restart.
TEST(Launcher, StartsAgainWhatRefusesItsArgumentsAfterItHasRunWithThem) {
  Folder folder;
  Launcher launcher(folder.path, "/bin/sh");
  const std::string ran = (folder.path / "ran").string();
  launcher.add(shell("test -e " + ran + " && exit 2; touch " + ran + "; sleep 3.2; exit 1"));
  EXPECT_TRUE(eventually([&] {
    launcher.poll();
    return launcher.processes()[0].starts == 3;
  }));
  EXPECT_FALSE(launcher.any_given_up());
}

TEST(Launcher, LeavesAProcessDeadThatIsNotToBeStartedAgain) {
  Folder folder;
  Launcher launcher(folder.path, "/bin/sh");
  ProcessSpec spec = shell("echo what went wrong; exit 1");
  spec.restart = false;
  launcher.add(spec);
  std::string said;
  ASSERT_TRUE(eventually([&] {
    for (const auto& line : launcher.poll()) said += line + "\n";
    return launcher.any_given_up();
  }));
  EXPECT_NE(said.find("what went wrong"), std::string::npos) << said;
  launcher.poll();
  EXPECT_EQ(launcher.processes()[0].starts, 1);
}

TEST(Launcher, StopsProcessesThatIgnoreTheRequest) {
  Folder folder;
  Launcher launcher(folder.path, "/bin/sh");
  launcher.add(shell("trap '' TERM; echo ready; exec sleep 60"));
  launcher.poll();
  ASSERT_TRUE(eventually([&] { return !launcher.log_tail("shell").empty(); }));
  const pid_t pid = launcher.processes()[0].pid;
  launcher.stop(100ms);
  EXPECT_NE(kill(-pid, 0), 0) << "the process group lives on";
}

TEST(Launcher, TakesItsProcessesAlongWhenItIsKilled) {
  Folder folder;
  int pipe_ends[2];
  ASSERT_EQ(pipe(pipe_ends), 0);
  const pid_t middle = fork();
  if (middle == 0) {
    Launcher launcher(folder.path, "/bin/sh");
    launcher.add(shell("exec sleep 60"));
    launcher.poll();
    const pid_t child = launcher.processes()[0].pid;
    if (write(pipe_ends[1], &child, sizeof child) < 0) _exit(1);
    pause();
  }
  pid_t child = 0;
  ASSERT_EQ(read(pipe_ends[0], &child, sizeof child), ssize_t{sizeof child});
  kill(middle, SIGKILL);
  waitpid(middle, nullptr, 0);
  EXPECT_TRUE(eventually([&] {
    std::ifstream stat("/proc/" + std::to_string(child) + "/stat");
    std::string line;  // an orphan that nobody reaps stays as a zombie
    return !std::getline(stat, line) || line.find(") Z") != std::string::npos;
  }));
  close(pipe_ends[0]);
  close(pipe_ends[1]);
}

}  // namespace
}  // namespace foretrack
