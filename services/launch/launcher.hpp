// SPDX-License-Identifier: Apache-2.0
// Runs services as processes of this program, restarts those that crash, and leaves nothing behind.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

namespace foretrack {

struct ProcessSpec {
  std::string name;                    // also that of its log file
  std::vector<std::string> arguments;  // behind the program's name: subcommand and options
  bool restart = true;                 // after a crash
  bool always = false;                 // also when it ends without one
  bool needed = true;                  // the others are of no use without it
};

/// A process under the launcher's care.
struct Process {
  using Clock = std::chrono::steady_clock;
  ProcessSpec spec;
  pid_t pid = -1;            // -1: not running
  int starts = 0;            // since the launcher's start; restarts = starts - 1
  int crashes_in_a_row = 0;  // forgotten once it has run for a while
  bool accepted =
      false;  // its arguments: what it refuses later may come back, as an interface does
  bool given_up = false;  // it refused its arguments, or was done: starting again helps nobody
  Clock::time_point started;
  Clock::time_point due;  // when it may start (again)
};

/// Not thread-safe. Call from the main thread, which must outlive the children: the kernel ends
/// them (SIGTERM) when it goes, however it goes.
class Launcher {
 public:
  /// Logs go to <log_folder>/<name>.log, appended; without a folder, to where this process writes.
  /// Throws std::runtime_error if that is impossible.
  explicit Launcher(std::filesystem::path log_folder,
                    std::filesystem::path program = "/proc/self/exe");
  ~Launcher() { stop(); }
  Launcher(const Launcher&) = delete;
  Launcher& operator=(const Launcher&) = delete;

  void add(ProcessSpec spec);
  /// Starts what is due, notices what has ended. Call about ten times a second. Returns a line for
  /// people about each crash and restart. Never blocks.
  std::vector<std::string> poll();
  /// SIGTERM to all, SIGKILL to those that still run after `patience`; then removes the shared
  /// memory that only they used. Returns 0.5 s after that at the latest; can be called again.
  void stop(std::chrono::milliseconds patience = std::chrono::seconds(2));

  const std::vector<Process>& processes() const { return processes_; }
  int restarts() const;
  /// A process that is needed ended for good: done, refused its arguments, or is not to be started
  /// again.
  bool any_given_up() const;
  std::filesystem::path log_of(const std::string& name) const;
  /// The log's last lines, to show with a crash.
  std::string log_tail(const std::string& name, int lines = 5) const;

 private:
  void start(Process& process);
  std::string reap(Process& process, int wait_status);
  void remember_shared_memory();
  bool wait_for_all(std::chrono::milliseconds limit);

  std::filesystem::path log_folder_;
  std::filesystem::path program_;
  std::vector<Process> processes_;
  std::set<std::string> shared_memory_;  // names that a child has had mapped
  Process::Clock::time_point looked_;    // at their memory
};

}  // namespace foretrack
