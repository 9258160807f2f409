// SPDX-License-Identifier: Apache-2.0
// Wall time from what was seen to a stage's answer.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <deque>
#include <string>
#include <vector>

#include "services/common/time_now.hpp"

namespace foretrack {

/// Of an unsorted copy; 0 if empty.
inline double quantile_of(std::vector<double> values, double share) {
  if (values.empty()) return 0.0;
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
}

/// Causes (observations, images) wait here until a sample shows that it was caused by them, or by a
/// later one.
class StageDelay {
 public:
  explicit StageDelay(std::string name) : name_(std::move(name)) {}

  /// at_s: from when on the delay counts, by the clock of answered().
  void caused(double stamp_s, double at_s) { waiting_.push_back({stamp_s, at_s}); }
  void answered(double stamp_s, double now_s) {
    while (!waiting_.empty() && waiting_.front().stamp_s <= stamp_s + 1e-6) {
      delays_ms_.push_back(1e3 * (now_s - waiting_.front().at_s));
      caused_s_.push_back(waiting_.front().at_s);
      waiting_.pop_front();
    }
  }
  void forget() {
    delays_ms_.clear();
    caused_s_.clear();
  }
  /// A line each: name, when its cause came, milliseconds.
  std::string rows() const {
    std::string text;
    for (std::size_t i = 0; i < delays_ms_.size(); ++i)
      text += fmt::format("{} {:.4f} {:.4f}\n", name_, caused_s_[i], delays_ms_[i]);
    return text;
  }
  double median_ms() const { return quantile_of(delays_ms_, 0.5); }
  std::string row() const {
    const auto at = [this](double share) { return quantile_of(delays_ms_, share); };
    return fmt::format("{:<14} {:6} {:8.1f} {:8.1f} {:8.1f} {:8.1f}\n", name_, delays_ms_.size(),
                       at(0.5), at(0.95), at(0.99), at(1.0));
  }
  static std::string head() {
    return fmt::format("{:<14} {:>6} {:>8} {:>8} {:>8} {:>8}\n", "", "n", "p50", "p95", "p99",
                       "max");
  }

 private:
  struct Waiting {
    double stamp_s, at_s;
  };
  std::string name_;
  std::deque<Waiting> waiting_;
  std::vector<double> delays_ms_, caused_s_;
};

}  // namespace foretrack
