// SPDX-License-Identifier: Apache-2.0
// What a demo flight was like: one value, as a table for people and as JSON for programs.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "services/offline/flight/metrics.hpp"
#include "services/operator/flight_log.hpp"

namespace foretrack {

struct ServiceSummary {
  double cpu_percent = 0.0;   // of one core, mean
  double memory_bytes = 0.0;  // proportional share, peak
  int restarts = 0;
};

struct FlightSummary {
  std::string scenario;
  std::string vehicle;
  int domain = 0;
  Metrics metrics;
  double wall_s = 0.0;  // that the flight took here
  double path_length_m = 0.0;
  int plans = 0;
  Quantiles latency_ms;          // image's stamp → setpoint, by the flight's clock
  Quantiles wall_latency_ms;     // the same by the wall's, from a rendered image's coming; 0: none
  double camera_delay_ms = 0.0;  // the simulated camera's part of it
  std::map<std::string, Quantiles> stage_ms;  // "plan", "plan: corridor", "predict", …
  std::map<std::string, ServiceSummary> services;
  ServiceSummary onboard;  // all services on the vehicle together
  std::string folder;

  /// The vehicle flew: it moved, and by plans.
  bool happened() const { return path_length_m > 0.5 && plans > 0; }
  bool good() const { return happened() && metrics.collisions == 0; }
};

/// Metrics and times; the services are left to the caller.
FlightSummary summarize(const FlightLog& log, const MetricParams& params);

std::string to_text(const FlightSummary& summary);
std::string to_json_text(const FlightSummary& summary);

}  // namespace foretrack
