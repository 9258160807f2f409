// SPDX-License-Identifier: Apache-2.0
// Rate of a counter, over the last seconds.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace foretrack {

/// Sampled at any period; remembers kMarks marks, at least kSpacing_s apart.
class RateMeter {
 public:
  /// Returns events per second over about the last two seconds. Precondition: now_s does not fall.
  double update(std::uint64_t count, double now_s) {
    if (used_ == 0 || now_s - newest().time_s >= kSpacing_s) {
      marks_[next_] = {count, now_s};
      next_ = (next_ + 1) % kMarks;
      if (used_ < kMarks) ++used_;
    }
    const Mark& oldest = marks_[used_ < kMarks ? 0 : next_];
    const double span_s = now_s - oldest.time_s;
    return span_s > 0.0 ? static_cast<double>(count - oldest.count) / span_s : 0.0;
  }

 private:
  struct Mark {
    std::uint64_t count = 0;
    double time_s = 0.0;
  };
  static constexpr std::size_t kMarks = 8;
  static constexpr double kSpacing_s = 0.25;
  const Mark& newest() const { return marks_[(next_ + kMarks - 1) % kMarks]; }

  std::array<Mark, kMarks> marks_{};
  std::size_t next_ = 0, used_ = 0;
};

}  // namespace foretrack
