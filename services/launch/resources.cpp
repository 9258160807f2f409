// SPDX-License-Identifier: Apache-2.0
#include "services/launch/resources.hpp"

#include <algorithm>

#include "services/launch/flight_processes.hpp"
#include "services/launch/usage.hpp"

namespace foretrack {

void ResourceMeter::sample(const Launcher& launcher) {
  const auto now = Process::Clock::now();
  const bool first = last_time_ == Process::Clock::time_point{};
  const double elapsed_s = first ? 0.0 : std::chrono::duration<double>(now - last_time_).count();
  last_time_ = now;
  double onboard_pss = 0.0;
  for (const auto& process : launcher.processes()) {
    const auto usage = process.pid > 0 ? usage_of(process.pid) : std::nullopt;
    if (!usage) continue;
    auto& use = uses_[process.spec.name];
    auto& last = last_[process.spec.name];
    if (last.pid != process.pid) last = {process.pid, first ? usage->cpu_s : 0.0};
    use.cpu_s += usage->cpu_s - last.cpu_s;
    last.cpu_s = usage->cpu_s;
    use.seconds += elapsed_s;
    const auto pss = static_cast<double>(usage->pss_bytes);
    use.pss_peak_bytes = std::max(use.pss_peak_bytes, pss);
    if (is_onboard(process.spec.name)) onboard_pss += pss;
  }
  onboard_pss_peak_bytes_ = std::max(onboard_pss_peak_bytes_, onboard_pss);
}

double ResourceMeter::onboard_cpu_percent() const {
  double sum = 0.0;
  for (const auto& [name, use] : uses_)
    if (is_onboard(name)) sum += use.cpu_percent();
  return sum;
}

}  // namespace foretrack
