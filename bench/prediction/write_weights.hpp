// SPDX-License-Identifier: Apache-2.0
// Fitted numbers as C++ source.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdio>
#include <ostream>
#include <span>
#include <vector>

namespace foretrack::bench {

inline void write_numbers(std::ostream& out, std::span<const double> values) {
  out << "{";
  for (std::size_t i = 0; i < values.size(); ++i) {
    char text[40];
    std::snprintf(text, sizeof text, "%.4g", values[i]);
    out << (i ? ", " : "") << text;
  }
  out << "}";
}

inline void write_row(std::ostream& out, const char* field, std::span<const double> values) {
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

inline void write_matrix(std::ostream& out, const char* field, const Eigen::MatrixXd& rows) {
  out << "    ." << field << " = {{";
  for (const auto& row : rows.rowwise())
    write_numbers(out, std::vector<double>(row.begin(), row.end())), out << ",\n";
  out << "}},\n";
}

}  // namespace foretrack::bench
