// SPDX-License-Identifier: Apache-2.0
#include "tests/fuzz/bus/attack.hpp"

#include <arpa/inet.h>
#include <fmt/format.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <deque>
#include <fstream>
#include <optional>
#include <stdexcept>
#include <thread>

#include "services/common/time_now.hpp"
#include "services/common/wire/check_message.hpp"
#include "services/launch/domain.hpp"
#include "tests/fuzz/bus/peer.hpp"

namespace foretrack::testing {
namespace {

using namespace std::chrono_literals;

/// The process under attack; killed with its owner.
class Victim {
 public:
  Victim(const AttackOptions& options, int domain) {
    auto words = options.program;
    if (words.empty()) words = {"/proc/self/exe", options.filtered ? "--victim" : "--open-victim"};
    words.insert(words.end(), {"--domain", std::to_string(domain)});
    if (!options.keys.empty()) words.insert(words.end(), {"--security", options.keys + "/vehicle"});
    pid_ = fork();
    if (pid_ != 0) return;
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    std::vector<char*> argv;
    for (auto& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);
    execvp(argv[0], argv.data());
    _exit(127);
  }
  ~Victim() {
    if (lives()) kill(pid_, SIGKILL), waitpid(pid_, nullptr, 0);
  }
  Victim(const Victim&) = delete;
  Victim& operator=(const Victim&) = delete;

  bool lives() {
    int status = 0;
    if (how_.empty() && waitpid(pid_, &status, WNOHANG) == pid_)
      how_ = WIFSIGNALED(status) ? fmt::format("by signal {}", sigabbrev_np(WTERMSIG(status)))
                                 : fmt::format("with code {}", WEXITSTATUS(status));
    return how_.empty();
  }
  const std::string& how() const { return how_; }
  pid_t pid() const { return pid_; }
  double memory_MB() const {
    std::ifstream file(fmt::format("/proc/{}/statm", pid_));
    double pages = 0.0, resident = 0.0;
    file >> pages >> resident;
    return resident * static_cast<double>(sysconf(_SC_PAGESIZE)) / 1e6;
  }

 private:
  pid_t pid_ = -1;
  std::string how_;
};

/// To the ports of a domain's first participant.
class Sender {
 public:
  explicit Sender(int domain) : first_(7400 + 250 * domain) {
    if (socket_ < 0) throw std::runtime_error("no socket");
  }
  ~Sender() { close(socket_); }
  Sender(const Sender&) = delete;
  Sender& operator=(const Sender&) = delete;

  void discovery(const Message& message) const { to(first_ + 10, message); }
  void samples(const Message& message) const { to(first_ + 11, message); }

 private:
  void to(int port, const Message& message) const {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<std::uint16_t>(port));
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    sendto(socket_, message.data(), message.size(), 0, reinterpret_cast<const sockaddr*>(&address),
           sizeof address);
  }

  int first_;
  int socket_ = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
};

bool is_let_through(const Message& message) {
  return wire::check_message(message).fault == wire::Fault::kNone;
}

std::string hex(const Message& message) {
  std::string text;
  for (const auto byte : message) text += fmt::format("{:02x}", byte);
  return text;
}

// Both speak until there are good messages of many kinds.
void gather(Peer& peer, const Seeds& seeds, Victim& victim) {
  int heard = 0;
  const double begin_s = steady_s();
  while (steady_s() - begin_s < 30.0 && victim.lives()) {
    peer.write();
    heard += peer.heard();
    if (heard > 30 && seeds.size() > 60 && steady_s() - begin_s > 3.0) return;
    std::this_thread::sleep_for(20ms);
  }
  if (!victim.lives()) throw std::runtime_error("the victim ended by itself " + victim.how());
  if (heard == 0) throw std::runtime_error("the victim says nothing");
}

class Attack {
 public:
  explicit Attack(const AttackOptions& options)
      : options_(options),
        victim_(options, domain_.id()),
        sender_(domain_.id()),
        seeds_(std::make_shared<Seeds>()) {}

  AttackResult run() {
    std::this_thread::sleep_for(1s);  // it shall be the first in its domain
    peer_.emplace(domain_.id(), seeds_, identity());
    if (options_.program.empty())
      gather(*peer_, *seeds_, victim_);
    else
      for (int i = 0; i < 250; ++i) peer_->write(), std::this_thread::sleep_for(20ms);
    result_.seeds = seeds_->size();
    const double end_s = steady_s() + options_.seconds;
    BadMessages bad(options_.seed, *seeds_);
    while (steady_s() < end_s && victim_.lives()) burst(bad);
    finish();
    return result_;
  }

 private:
  std::string identity() const { return options_.keys.empty() ? "" : options_.keys + "/operator"; }
  void burst(BadMessages& bad) {
    constexpr int kBurst = 40;  // and a pause, so that the socket's buffer takes them
    for (int i = 0; i < kBurst; ++i) send(bad.next());
    peer_->write();
    peer_->heard();
    std::this_thread::sleep_for(1ms);
  }
  void send(const Message& message) {
    const bool good = is_let_through(message);
    // What is refused only shows that it is refused: a few of them will do.
    if (!good && ++refused_ % 16 != 0) return;
    ++result_.sent;
    result_.let_through += good ? 1 : 0;
    last_.push_back(message);
    if (last_.size() > 400) last_.pop_front();
    if (result_.sent % 2 == 0)
      sender_.discovery(message);
    else
      sender_.samples(message);
  }
  void finish() {
    result_.ended = !victim_.lives();
    result_.how = victim_.how();
    result_.memory_MB = victim_.memory_MB();
    peer_.reset();
    if (result_.ended) return keep();
    Peer newcomer(domain_.id(), std::make_shared<Seeds>(), identity());
    const double end_s = steady_s() + 40.0;
    while (!result_.hears && steady_s() < end_s) {
      std::this_thread::sleep_for(50ms);
      result_.hears = newcomer.heard() > 0 || !options_.program.empty();
    }
    result_.ended = !victim_.lives();
    result_.how = victim_.how();
    if (result_.ended || !result_.hears) keep();
    if (!result_.ended && !result_.hears && options_.hold_s > 0.0) {
      fmt::print("process {} hears nobody\n", victim_.pid());
      std::fflush(stdout);
      std::this_thread::sleep_for(std::chrono::duration<double>(options_.hold_s));
    }
  }
  void keep() const {
    if (options_.record.empty()) return;
    std::ofstream file(options_.record);
    for (const auto& message : last_) file << hex(message) << '\n';
  }

  AttackOptions options_;
  FreeDomain domain_;
  Victim victim_;
  Sender sender_;
  std::shared_ptr<Seeds> seeds_;
  std::optional<Peer> peer_;
  std::deque<Message> last_;
  std::uint64_t refused_ = 0;
  AttackResult result_;
};

}  // namespace

AttackResult attack(const AttackOptions& options) {
  return Attack(options).run();
}

std::string send_one(const Message& message, const AttackOptions& options) {
  const FreeDomain domain;
  Victim victim(options, domain.id());
  const Sender sender(domain.id());
  for (int i = 0; i < 30 && victim.lives(); ++i) {
    std::this_thread::sleep_for(100ms);
    sender.discovery(message);
    sender.samples(message);
  }
  victim.lives();
  return victim.how();
}

}  // namespace foretrack::testing
