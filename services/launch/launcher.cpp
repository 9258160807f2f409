// SPDX-License-Identifier: Apache-2.0
#include "services/launch/launcher.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <deque>
#include <fstream>
#include <stdexcept>
#include <thread>

#include "services/launch/shared_memory.hpp"

namespace foretrack {
namespace {

using namespace std::chrono_literals;
constexpr auto kFirstBackOff = 100ms;
constexpr auto kLongestBackOff = 5s;
constexpr auto kHealthyAfter = 10s;
constexpr auto kAcceptedAfter = 3s;  // by then it would have refused its arguments
constexpr auto kKillPatience = 500ms;
constexpr auto kLookPeriod = 500ms;

// What the child does between fork and exec: only async-signal-safe calls.
[[noreturn]] void become(const char* program, char* const* arguments, int log, pid_t parent) {
  setpgid(0, 0);  // a Ctrl-C at the terminal reaches the launcher alone
  prctl(PR_SET_PDEATHSIG, SIGTERM);
  if (getppid() != parent) _exit(0);  // it died before prctl
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);
  for (const int s : {SIGINT, SIGTERM, SIGPIPE}) signal(s, SIG_DFL);
  const int null = open("/dev/null", O_RDONLY);
  if (null >= 0) dup2(null, STDIN_FILENO);
  if (log >= 0) {
    dup2(log, STDOUT_FILENO);
    dup2(log, STDERR_FILENO);
  }
  execv(program, arguments);
  _exit(127);
}

std::string describe(int wait_status) {
  if (WIFSIGNALED(wait_status))
    return fmt::format("was killed by {}", sigabbrev_np(WTERMSIG(wait_status)));
  return fmt::format("ended with code {}", WEXITSTATUS(wait_status));
}

// -1: there is none.
int open_log(const std::filesystem::path& path) {
  if (path.empty()) return -1;
  const int log = open(path.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0644);
  if (log < 0)
    throw std::runtime_error(fmt::format("cannot write {}: {}", path.string(), strerror(errno)));
  return log;
}

// What a user must correct: 2 by our own commands, 100 and above by the parser of arguments.
bool is_misuse(int exit_code) {
  return exit_code == 2 || (exit_code >= 100 && exit_code < 126);
}

// The first time at once: a vehicle may be in the air.
std::chrono::milliseconds back_off(int crashes_in_a_row) {
  if (crashes_in_a_row <= 1) return 0ms;
  const int doublings = std::min(crashes_in_a_row - 1, 10);
  return std::min<std::chrono::milliseconds>(kFirstBackOff * (1 << doublings), kLongestBackOff);
}

}  // namespace

Launcher::Launcher(std::filesystem::path log_folder, std::filesystem::path program)
    : log_folder_(std::move(log_folder)), program_(std::move(program)) {
  if (log_folder_.empty()) return;
  std::error_code error;
  std::filesystem::create_directories(log_folder_, error);
  if (error)
    throw std::runtime_error(
        fmt::format("cannot create the folder {}: {}", log_folder_.string(), error.message()));
}

void Launcher::add(ProcessSpec spec) {
  processes_.push_back({.spec = std::move(spec), .started = {}, .due = {}});
}

std::filesystem::path Launcher::log_of(const std::string& name) const {
  if (log_folder_.empty()) return {};
  return log_folder_ / (name + ".log");
}

std::string Launcher::log_tail(const std::string& name, int lines) const {
  std::ifstream file(log_of(name));
  std::deque<std::string> tail;
  for (std::string line; std::getline(file, line);) {
    tail.push_back("  " + name + "| " + line);
    if (tail.size() > static_cast<std::size_t>(lines)) tail.pop_front();
  }
  return fmt::format("{}", fmt::join(tail, "\n"));
}

int Launcher::restarts() const {
  int sum = 0;
  for (const auto& p : processes_) sum += std::max(0, p.starts - 1);
  return sum;
}

bool Launcher::any_given_up() const {
  return std::any_of(processes_.begin(), processes_.end(), [](const Process& process) {
    return process.given_up && process.spec.needed;
  });
}

void Launcher::start(Process& process) {
  const int log = open_log(log_of(process.spec.name));
  std::vector<std::string> words = process.spec.arguments;
  words.insert(words.begin(), "foretrack");
  std::vector<char*> argv;
  for (auto& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  const pid_t parent = getpid();
  const pid_t pid = fork();
  if (pid == 0) become(program_.c_str(), argv.data(), log, parent);
  if (log >= 0) close(log);
  if (pid < 0) throw std::runtime_error(fmt::format("fork: {}", strerror(errno)));
  setpgid(pid, pid);
  process.pid = pid;
  process.started = Process::Clock::now();
  ++process.starts;
}

std::string Launcher::reap(Process& process, int wait_status) {
  const auto now = Process::Clock::now();
  process.pid = -1;
  if (now - process.started > kHealthyAfter) process.crashes_in_a_row = 0;
  ++process.crashes_in_a_row;
  process.accepted |= now - process.started > kAcceptedAfter;
  const std::string what = process.spec.name + " " + describe(wait_status);
  const bool exited = WIFEXITED(wait_status);
  if (exited && WEXITSTATUS(wait_status) == 0 && !process.spec.always) {
    process.given_up = true;
    return what;
  }
  if (exited && is_misuse(WEXITSTATUS(wait_status)) && !process.accepted) {
    process.given_up = true;
    return what + " and is not started again:\n" + log_tail(process.spec.name);
  }
  if (!process.spec.restart) {
    process.given_up = true;
    return what + ":\n" + log_tail(process.spec.name);
  }
  const auto wait = back_off(process.crashes_in_a_row);
  process.due = now + wait;
  return wait == 0ms ? what : fmt::format("{}; starts again in {} ms", what, wait.count());
}

std::vector<std::string> Launcher::poll() {
  std::vector<std::string> lines;
  const auto now = Process::Clock::now();
  for (auto& process : processes_) {
    int status = 0;
    if (process.pid > 0 && waitpid(process.pid, &status, WNOHANG) == process.pid)
      lines.push_back(reap(process, status));
    if (process.pid < 0 && !process.given_up && now >= process.due) {
      start(process);
      if (process.starts > 1) lines.push_back(process.spec.name + " started again");
    }
  }
  if (now - looked_ > kLookPeriod) remember_shared_memory();
  return lines;
}

// A killed process cannot say what it leaves behind, so its memory is noted while it lives.
void Launcher::remember_shared_memory() {
  looked_ = Process::Clock::now();
  for (const auto& process : processes_)
    if (process.pid > 0) shared_memory_.merge(mapped_shared_memory(process.pid));
}

bool Launcher::wait_for_all(std::chrono::milliseconds limit) {
  const auto end = Process::Clock::now() + limit;
  for (;;) {
    bool any = false;
    for (auto& process : processes_) {
      if (process.pid > 0 && waitpid(process.pid, nullptr, WNOHANG) != 0) process.pid = -1;
      any = any || process.pid > 0;
    }
    if (!any) return true;
    if (Process::Clock::now() >= end) return false;
    std::this_thread::sleep_for(5ms);
  }
}

void Launcher::stop(std::chrono::milliseconds patience) {
  remember_shared_memory();
  const auto signal_all = [&](int number) {
    for (const auto& process : processes_)
      if (process.pid > 0) kill(-process.pid, number);
  };
  signal_all(SIGTERM);
  if (!wait_for_all(patience)) {
    signal_all(SIGKILL);
    wait_for_all(kKillPatience);
  }
  for (auto& process : processes_) process.given_up = true;
  remove_shared_memory(shared_memory_);
}

}  // namespace foretrack
