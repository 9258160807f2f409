// SPDX-License-Identifier: Apache-2.0
// One row per parameter: the same rows load, validate, print and document.
//
// Every params struct P has `ParamRows rows(P&)`: one row per field, in the order in which they are
// documented. Meanings are written there; the comments at the fields are copies, which `./run
// format` makes.
#pragma once

#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace foretrack {

/// A view of one field of a params struct. It is valid as long as the struct is.
struct ParamRow {
  std::string_view name;                     ///< as in parameter files; ends in its unit
  std::variant<double*, int*, bool*> value;  ///< the field
  std::string_view unit;                     ///< "1": a ratio or a count
  double min = 0.0;                          ///< least allowed value
  double max = 0.0;                          ///< greatest allowed value
  std::string_view meaning;                  ///< a phrase for whoever sets it
};
using ParamRows = std::vector<ParamRow>;

/// One line for each value that is not finite or out of its range. Empty: all are valid.
std::vector<std::string> faults_of(const ParamRows& rows);
/// Throws std::invalid_argument that names the stage and lists every fault.
void validate_or_throw(std::string_view stage, const ParamRows& rows);
/// Sets the row of that name from text. Returns the fault (no such name, bad text, out of range) or
/// an empty string. A value that is out of range has been set all the same.
std::string set_param(const ParamRows& rows, std::string_view name, std::string_view text);
/// The value as a parameter file would have it.
std::string text_of(const ParamRow& row);

}  // namespace foretrack
