// SPDX-License-Identifier: Apache-2.0
// CPU time of the calling thread: what a measurement on a busy machine can rely on.
#pragma once

#include <ctime>

namespace foretrack {

inline double cpu_s() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}
inline double cpu_ms() {
  return 1e3 * cpu_s();
}

}  // namespace foretrack
