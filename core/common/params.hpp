// SPDX-License-Identifier: Apache-2.0
// One row per parameter: the same rows load, validate, print and document.
#pragma once

#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace foretrack {

/// A view of one field of a params struct. Valid as long as the struct is.
struct ParamRow {
  std::string_view name;  // ends in its unit
  std::variant<double*, int*, bool*> value;
  std::string_view unit;
  double min = 0.0;
  double max = 0.0;
  std::string_view meaning;
};
using ParamRows = std::vector<ParamRow>;

/// Every params struct P has `ParamRows rows(P&)`, in the order in which they are documented.

/// One line per fault: NaN or out of range. Empty: all are valid.
std::vector<std::string> faults_of(const ParamRows& rows);
/// Throws std::invalid_argument that lists every fault.
void validate_or_throw(std::string_view stage, const ParamRows& rows);
/// Sets the named row from text. Returns the fault, or an empty string. Unknown names and bad text
/// are faults.
std::string set_param(const ParamRows& rows, std::string_view name, std::string_view text);
/// The value as text, as a parameter file would have it.
std::string text_of(const ParamRow& row);

}  // namespace foretrack
