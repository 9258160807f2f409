// SPDX-License-Identifier: Apache-2.0
// Fitted numbers as C++ source.
#pragma once

#include <array>
#include <cstdio>
#include <ostream>

namespace foretrack::bench {

template <std::size_t N>
void write_numbers(std::ostream& out, const std::array<double, N>& values) {
  out << "{";
  for (std::size_t i = 0; i < N; ++i) {
    char text[40];
    std::snprintf(text, sizeof text, "%.4g", values[i]);
    out << (i ? ", " : "") << text;
  }
  out << "}";
}

template <std::size_t N>
void write_row(std::ostream& out, const char* field, const std::array<double, N>& values) {
  out << "    ." << field << " = ";
  write_numbers(out, values);
  out << ",\n";
}

template <std::size_t N, std::size_t M>
void write_rows(std::ostream& out, const char* field,
                const std::array<std::array<double, N>, M>& rows) {
  out << "    ." << field << " = {{";
  for (const auto& row : rows) write_numbers(out, row), out << ",\n";
  out << "}},\n";
}

}  // namespace foretrack::bench
