// SPDX-License-Identifier: Apache-2.0
#include "services/convert/checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace foretrack {

void Checks::fail(std::string_view field, std::string_view value, std::string_view expected) {
  if (fault_) return;
  fault_ = Fault{field, fmt::format("{} is {}, expected {}", field, value, expected)};
}

// The comparisons are written so that NaN fails them.
void Checks::in_range(std::string_view field, double value, double min, double max) {
  if (value >= min && value <= max) return;
  fail(field, fmt::format("{}", value), fmt::format("{} to {}", min, max));
}

void Checks::positive(std::string_view field, double value, double max) {
  if (value > 0.0 && value <= max) return;
  fail(field, fmt::format("{}", value), fmt::format("above 0, to {}", max));
}

void Checks::within(std::string_view field, double value, double limit) {
  if (std::abs(value) <= limit) return;
  fail(field, fmt::format("{}", value), fmt::format("finite, within ±{}", limit));
}

void Checks::count(std::string_view field, std::size_t size, std::size_t min, std::size_t max) {
  if (size >= min && size <= max) return;
  fail(field, fmt::format("{} long", size),
       min == max ? fmt::format("{}", min) : fmt::format("{} to {}", min, max));
}

void Checks::enumerator(std::string_view field, unsigned value, unsigned last) {
  if (value <= last) return;
  fail(field, fmt::format("{}", value), fmt::format("a constant, 0 to {}", last));
}

void Checks::stamp(std::string_view field, const builtin_interfaces::msg::Time& time) {
  if (time.sec() >= 0 && time.nanosec() < 1'000'000'000u) return;
  fail(field, fmt::format("{} s {} ns", time.sec(), time.nanosec()),
       "not negative, and less than 1e9 ns");
}

void Checks::frame(std::string_view field, std::string_view name, std::string_view expected) {
  if (name == expected) return;
  fail(field, fmt::format("'{}'", name.substr(0, 64)), fmt::format("'{}'", expected));
}

void Checks::sums_to_one(std::string_view field, double sum) {
  if (std::abs(sum - 1.0) <= limits::kSumTolerance) return;
  fail(field, fmt::format("{} in sum", sum), "1 in sum");
}

void Checks::unit(std::string_view field, double norm) {
  if (std::abs(norm - 1.0) <= limits::kUnitTolerance) return;
  fail(field, fmt::format("{} long", norm), "of unit length");
}

void Checks::covariance(std::string_view field, const double* values, int n) {
  for (int i = 0; i < n; ++i) in_range(field, values[i * n + i], 0.0, limits::kVariance);
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < i; ++j) {
      const double a = values[i * n + j], b = values[j * n + i];
      const double most = std::sqrt(values[i * n + i] * values[j * n + j]);
      if (!(std::abs(a) <= most * (1.0 + 1e-6) + 1e-9))
        fail(field, fmt::format("{} at ({}, {})", a, i, j), fmt::format("within ±{}", most));
      if (!(std::abs(a - b) <= 1e-6 * most + 1e-9))
        fail(field, fmt::format("{} and {} across the diagonal", a, b), "symmetric");
    }
  }
}

}  // namespace foretrack
