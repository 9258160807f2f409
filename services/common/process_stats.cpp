// SPDX-License-Identifier: Apache-2.0
#include "services/common/process_stats.hpp"

#include <sys/resource.h>
#include <unistd.h>

#include <fstream>

#include "services/common/time_now.hpp"

namespace foretrack {
namespace {

double seconds(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

double cpu_seconds() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

}  // namespace

CpuMeter::CpuMeter() : cpu_s_(cpu_seconds()), wall_s_(steady_s()) {}

double CpuMeter::percent() {
  const double cpu = cpu_seconds();
  const double wall = steady_s();
  const double percent = wall > wall_s_ ? 100.0 * (cpu - cpu_s_) / (wall - wall_s_) : 0.0;
  cpu_s_ = cpu;
  wall_s_ = wall;
  return percent;
}

std::uint64_t resident_bytes() {
  std::ifstream file("/proc/self/statm");
  std::uint64_t total_pages = 0;
  std::uint64_t resident_pages = 0;
  file >> total_pages >> resident_pages;
  return resident_pages * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
}

}  // namespace foretrack
