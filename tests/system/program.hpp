// SPDX-License-Identifier: Apache-2.0
// The program under test, as a user runs it.
#pragma once

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

namespace foretrack {

using Json = nlohmann::json;
using Seconds = std::chrono::duration<double>;

/// A folder that goes with its owner.
struct Folder {
  Folder() {
    char name[] = "/tmp/foretrack-test-XXXXXX";
    path = mkdtemp(name);
  }
  ~Folder() { std::filesystem::remove_all(path); }
  std::filesystem::path path;
};

inline std::string text_of(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

inline bool eventually(const std::function<bool()>& condition, double limit_s) {
  const auto end = std::chrono::steady_clock::now() + Seconds(limit_s);
  while (!condition()) {
    if (std::chrono::steady_clock::now() > end) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  return true;
}

/// One run of the program; killed with its owner.
class Program {
 public:
  Program(std::vector<std::string> arguments, const std::filesystem::path& output,
          const char* path = FORETRACK_PROGRAM)
      : output_(output) {
    std::vector<char*> argv{const_cast<char*>(path)};
    for (auto& word : arguments) argv.push_back(word.data());
    argv.push_back(nullptr);
    pid_ = fork();
    if (pid_ != 0) return;
    if (!freopen(output.c_str(), "w", stdout)) _exit(126);
    dup2(STDOUT_FILENO, STDERR_FILENO);
    execv(path, argv.data());
    _exit(127);
  }
  ~Program() {
    if (running()) kill(pid_, SIGKILL);
    wait(10.0);
  }
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  pid_t pid() const { return pid_; }
  std::string output() const { return text_of(output_); }
  void send(int signal) { kill(pid_, signal); }
  bool running() {
    int status = 0;
    if (!done_ && waitpid(pid_, &status, WNOHANG) == pid_) {
      done_ = true;
      exit_code_ = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    }
    return !done_;
  }
  /// The exit code; −1 if it still runs after the limit.
  int wait(double limit_s) {
    return eventually([this] { return !running(); }, limit_s) ? exit_code_ : -1;
  }

 private:
  pid_t pid_ = -1;
  bool done_ = false;
  int exit_code_ = -1;
  std::filesystem::path output_;
};

/// Processes whose command line holds the text, e.g. a service of one domain.
inline std::vector<pid_t> processes_with(const std::vector<std::string>& words) {
  std::vector<pid_t> pids;
  for (const auto& entry : std::filesystem::directory_iterator("/proc")) {
    const std::string name = entry.path().filename();
    if (name.find_first_not_of("0123456789") != std::string::npos) continue;
    std::string line = text_of(entry.path() / "cmdline");
    std::replace(line.begin(), line.end(), '\0', ' ');
    bool all = !line.empty();
    for (const auto& word : words) all = all && line.find(word + " ") != std::string::npos;
    if (all && line.starts_with("foretrack ")) pids.push_back(std::stoi(name));
  }
  return pids;
}

/// Files of Fast DDS in shared memory that these processes use.
inline std::set<std::string> shared_memory_of(const std::vector<pid_t>& pids) {
  std::set<std::string> files;
  for (const pid_t pid : pids) {
    std::istringstream maps(text_of("/proc/" + std::to_string(pid) + "/maps"));
    for (std::string line; std::getline(maps, line);)
      if (const auto at = line.find("/dev/shm/fastrtps_"); at != std::string::npos)
        files.insert(line.substr(at));
  }
  return files;
}

/// The last line of JSON that was printed; an empty object: there is none.
inline Json last_json(const std::string& output) {
  std::istringstream lines(output);
  Json last = Json::object();
  for (std::string line; std::getline(lines, line);)
    if (auto json = Json::parse(line, nullptr, false); json.is_object()) last = std::move(json);
  return last;
}

/// The gate's mode in a line of the monitor; empty: nothing is heard of it.
inline std::string mode_in(const Json& monitor) {
  const auto safety = monitor.value("safety", Json());
  return safety.is_object() ? safety.value("mode", "") : "";
}

/// As an operator would: orders, and looks whether it flies. On a busy machine the vehicle may be
/// given up, or not be heard yet, just when the order comes.
inline bool flies_on_order(const std::function<std::string()>& mode,
                           const std::function<bool(const std::string&)>& order) {
  return eventually(
      [&] {
        if (mode() == "track") return true;
        if (!order("resume")) order("start");
        return mode() == "track";
      },
      60.0);
}

}  // namespace foretrack
