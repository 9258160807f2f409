// SPDX-License-Identifier: Apache-2.0
// What a message must satisfy before its values reach core. Bounds of the IDL are not enforced on
// the wire, so that every size, range and stamp is checked here, once.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>

#include "builtin_interfaces/msg/Time.h"
#include "core/common/geometry.hpp"

namespace foretrack {

/// Why a message was refused.
struct Fault {
  std::string_view field;  // a literal, so that refusals can be counted by it
  std::string text;        // field, value, and what was expected
};

/// A value, or why there is none.
template <class T>
class Converted {
 public:
  Converted(T value) : content_(std::move(value)) {}
  Converted(Fault fault) : content_(std::move(fault)) {}

  explicit operator bool() const { return content_.index() == 0; }
  T& operator*() { return std::get<0>(content_); }
  const T& operator*() const { return std::get<0>(content_); }
  T* operator->() { return &std::get<0>(content_); }
  const T* operator->() const { return &std::get<0>(content_); }
  /// Precondition: no value.
  const Fault& fault() const { return std::get<1>(content_); }

 private:
  std::variant<T, Fault> content_;
};

namespace limits {
inline constexpr double kPosition_m = 1e5;
inline constexpr double kSpeed_m_s = 200.0;
inline constexpr double kAcceleration_m_s2 = 1e3;
inline constexpr double kRate_rad_s = 100.0;
inline constexpr double kAngle_rad = 1e3;  // continuous angles may have wound up
inline constexpr double kVariance = 1e9;
inline constexpr double kDuration_s = 600.0;
inline constexpr double kUnitTolerance = 1e-2;
inline constexpr double kSumTolerance = 1e-3;
}  // namespace limits

/// Keeps the first fault; later checks do nothing. Field names are literals.
class Checks {
 public:
  bool ok() const { return !fault_; }
  void fail(std::string_view field, std::string_view value, std::string_view expected);

  void in_range(std::string_view field, double value, double min, double max);
  void positive(std::string_view field, double value, double max);
  /// Finite, and no larger than limit either way.
  void within(std::string_view field, double value, double limit);
  template <class T, std::size_t N>
  void within(std::string_view field, const std::array<T, N>& values, double limit) {
    for (const T v : values) within(field, v, limit);
  }
  void count(std::string_view field, std::size_t size, std::size_t min, std::size_t max);
  void enumerator(std::string_view field, unsigned value, unsigned last);
  /// Not negative; nanoseconds below a second.
  void stamp(std::string_view field, const builtin_interfaces::msg::Time& time);
  void frame(std::string_view field, std::string_view name, std::string_view expected);
  void sums_to_one(std::string_view field, double sum);
  void unit(std::string_view field, double norm);
  /// Row-major n × n: finite, symmetric, variances not negative, correlations within ±1.
  void covariance(std::string_view field, const double* values, int n);

  /// The fault if there was one, else the value.
  template <class T>
  Converted<T> result(T value) {
    if (fault_) return std::move(*fault_);
    return value;
  }

 private:
  std::optional<Fault> fault_;
};

}  // namespace foretrack
