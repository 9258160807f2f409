// SPDX-License-Identifier: Apache-2.0
// What each process of a flight used, over the flight.
#pragma once

#include <map>
#include <string>

#include "services/launch/launcher.hpp"

namespace foretrack {

struct ResourceUse {
  double cpu_s = 0.0;    // over all starts
  double seconds = 0.0;  // that it was watched
  double pss_peak_bytes = 0.0;
  double cpu_percent() const { return seconds > 0.0 ? 100.0 * cpu_s / seconds : 0.0; }
};

class ResourceMeter {
 public:
  /// Call it about once a second, while the flight lasts.
  void sample(const Launcher& launcher);
  const std::map<std::string, ResourceUse>& by_process() const { return uses_; }
  /// Largest sum of the vehicle's own services at one time.
  double onboard_pss_peak_bytes() const { return onboard_pss_peak_bytes_; }
  double onboard_cpu_percent() const;

 private:
  struct Last {
    pid_t pid = -1;
    double cpu_s = 0.0;
  };
  std::map<std::string, ResourceUse> uses_;
  std::map<std::string, Last> last_;
  Process::Clock::time_point last_time_{};
  double onboard_pss_peak_bytes_ = 0.0;
};

}  // namespace foretrack
