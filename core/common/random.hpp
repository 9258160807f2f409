// SPDX-License-Identifier: Apache-2.0
// Seeded random numbers that are the same on every machine (the standard's distributions are not).
#pragma once

#include <cmath>
#include <cstdint>

#include "core/common/geometry.hpp"

namespace foretrack {

/// The generator SplitMix64 (Steele, Lea and Flood 2014). The same seed gives the same numbers. For
/// one thread at a time. Cost: a few nanoseconds a number.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}
  /// 64 random bits.
  std::uint64_t next() {
    std::uint64_t z = (state_ += 0x9E3779B97F4A7C15ULL);
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9ULL;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBULL;
    return z ^ (z >> 31);
  }
  /// In [0, 1).
  double uniform() { return static_cast<double>(next() >> 11) * 0x1.0p-53; }
  /// In [low, high).
  double uniform(double low, double high) { return low + (high - low) * uniform(); }
  /// In [low, high], both ends included; each is as likely.
  int integer(int low, int high) { return low + static_cast<int>(uniform() * (high - low + 1)); }
  /// True with this probability; 0: never, 1: always.
  bool chance(double probability) { return uniform() < probability; }
  /// Standard normal (Box and Muller).
  double normal() {
    const double u = 1.0 - uniform(), v = uniform();
    return std::sqrt(-2.0 * std::log(u)) * std::cos(2.0 * kPi * v);
  }
  /// Normal with this mean and standard deviation.
  double normal(double mean, double sigma) { return mean + sigma * normal(); }

 private:
  std::uint64_t state_;
};

}  // namespace foretrack
