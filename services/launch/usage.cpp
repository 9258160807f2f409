// SPDX-License-Identifier: Apache-2.0
#include "services/launch/usage.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <fstream>
#include <sstream>
#include <string>

namespace foretrack {
namespace {

std::optional<double> cpu_s(pid_t pid) {
  std::ifstream file(fmt::format("/proc/{}/stat", pid));
  std::string line;
  if (!std::getline(file, line)) return std::nullopt;
  // The program's name is in brackets and may hold spaces; utime and stime are words 12 and 13
  // behind it.
  std::istringstream words(line.substr(line.rfind(')') + 1));
  std::string skipped;
  for (int i = 0; i < 11; ++i) words >> skipped;
  double user = 0.0, system = 0.0;
  words >> user >> system;
  return (user + system) / static_cast<double>(sysconf(_SC_CLK_TCK));
}

std::uint64_t pss_bytes(pid_t pid) {
  std::ifstream file(fmt::format("/proc/{}/smaps_rollup", pid));
  for (std::string line; std::getline(file, line);)
    if (line.starts_with("Pss:")) return std::stoull(line.substr(4)) * 1024;
  return 0;
}

}  // namespace

std::optional<ProcessUsage> usage_of(pid_t pid) {
  const auto cpu = cpu_s(pid);
  if (!cpu) return std::nullopt;
  return ProcessUsage{*cpu, pss_bytes(pid)};
}

}  // namespace foretrack
