// SPDX-License-Identifier: Apache-2.0
// What time it is by the clocks of this machine. Services that may run on simulated time ask their
// node's Clock instead (clock.hpp).
#pragma once

#include <chrono>
#include <cstdint>
#include <ctime>

namespace foretrack {

/// Seconds of a clock of <ctime>: CLOCK_BOOTTIME, CLOCK_THREAD_CPUTIME_ID, …
inline double seconds_by(clockid_t clock) {
  timespec t{};
  clock_gettime(clock, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

/// For periods: never set, and stands still in standby.
inline double steady_s() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// For periods that go on in standby.
inline double boot_s() {
  return seconds_by(CLOCK_BOOTTIME);
}

/// Nanoseconds since 1970; jumps when the system's clock is set.
inline std::int64_t now_ns() {
  using namespace std::chrono;
  return duration_cast<nanoseconds>(system_clock::now().time_since_epoch()).count();
}

/// CPU time of the calling thread: what a measurement on a busy machine can rely on.
inline double cpu_s() {
  return seconds_by(CLOCK_THREAD_CPUTIME_ID);
}
inline double cpu_ms() {
  return 1e3 * cpu_s();
}

}  // namespace foretrack
