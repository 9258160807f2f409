// SPDX-License-Identifier: Apache-2.0
// Two hosts on one machine, and a network between them.
#pragma once

#include "tests/system/program.hpp"

namespace foretrack {

inline constexpr int kVehicle = 0, kGate = 1;  // the hosts
inline constexpr char kAddressOfVehicle[] = "198.18.78.1", kAddressOfGate[] = "198.18.78.2";

/// Two network namespaces, and what connects them; gone with their owner.
class TwoHostsNetwork {
 public:
  explicit TwoHostsNetwork(const std::filesystem::path& folder, std::vector<std::string> more = {})
      : loss_file_(folder / "loss"),
        program_((lose("0"), arguments(std::move(more))), folder / "network.out", "/usr/bin/env") {}

  bool is_ready() {
    eventually([this] { return !program_.running() || is_up(); }, 20.0);
    if (!program_.running() || !is_up()) return false;
    std::string word;
    std::istringstream(program_.output()) >> word >> hosts_[0] >> hosts_[1];
    return true;
  }
  /// The share of packets that is lost.
  void lose(const std::string& share) {
    const std::filesystem::path fresh = loss_file_.string() + ".new";
    std::ofstream(fresh) << share;
    std::filesystem::rename(fresh, loss_file_);
  }
  /// Arguments of /usr/bin/env for a program on one of the hosts.
  std::vector<std::string> on(int host, std::vector<std::string> words,
                              const char* program = FORETRACK_PROGRAM) const {
    words.insert(words.begin(), {"nsenter", "--net=/proc/" + hosts_[host] + "/ns/net", program});
    return words;
  }

 private:
  std::vector<std::string> arguments(std::vector<std::string> more) const {
    more.insert(more.begin(), {"python3", FORETRACK_SOURCE_DIR "/tests/system/two_hosts.py",
                               loss_file_.string()});
    return more;
  }
  bool is_up() const { return program_.output().find("ready") != std::string::npos; }

  std::filesystem::path loss_file_;
  std::string hosts_[2];
  Program program_;
};

}  // namespace foretrack
