// SPDX-License-Identifier: Apache-2.0
#include "core/common/params.hpp"

#include <charconv>
#include <cmath>
#include <cstdio>
#include <stdexcept>

namespace foretrack {
namespace {

std::string number_text(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.10g", value);
  return text;
}

std::string fault_of(const ParamRow& row) {
  double value = 0.0;
  if (const auto* d = std::get_if<double*>(&row.value)) value = **d;
  if (const auto* i = std::get_if<int*>(&row.value)) value = **i;
  if (std::holds_alternative<bool*>(row.value)) return {};
  if (std::isfinite(value) && value >= row.min && value <= row.max) return {};
  return std::string(row.name) + ": " + text_of(row) + " is not in [" + number_text(row.min) +
         ", " + number_text(row.max) + "] " + std::string(row.unit);
}

// What false and true of a flag are called: its unit, as "filter|network", or these words.
std::pair<std::string_view, std::string_view> words_of(const ParamRow& row) {
  const std::size_t bar = row.unit.find('|');
  if (bar == std::string_view::npos) return {"false", "true"};
  return {row.unit.substr(0, bar), row.unit.substr(bar + 1)};
}

template <class T>
bool parse(std::string_view text, T& value) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size();
}

bool assign(const ParamRow& row, std::string_view text) {
  if (auto* const* d = std::get_if<double*>(&row.value)) return parse(text, **d);
  if (auto* const* i = std::get_if<int*>(&row.value)) return parse(text, **i);
  const auto [no, yes] = words_of(row);
  if (text != yes && text != no) return false;
  *std::get<bool*>(row.value) = text == yes;
  return true;
}

std::string expected(const ParamRow& row) {
  if (std::holds_alternative<double*>(row.value)) return "a number";
  if (std::holds_alternative<int*>(row.value)) return "a whole number";
  const auto [no, yes] = words_of(row);
  return std::string(yes) + " or " + std::string(no);
}

}  // namespace

std::string text_of(const ParamRow& row) {
  if (const auto* d = std::get_if<double*>(&row.value)) return number_text(**d);
  if (const auto* i = std::get_if<int*>(&row.value)) return std::to_string(**i);
  const auto [no, yes] = words_of(row);
  return std::string(*std::get<bool*>(row.value) ? yes : no);
}

std::vector<std::string> faults_of(const ParamRows& rows) {
  std::vector<std::string> faults;
  for (const auto& row : rows)
    if (std::string fault = fault_of(row); !fault.empty()) faults.push_back(std::move(fault));
  return faults;
}

void validate_or_throw(std::string_view stage, const ParamRows& rows) {
  const auto faults = faults_of(rows);
  if (faults.empty()) return;
  std::string message = std::string(stage) + " parameters:";
  for (const auto& fault : faults) message += "\n  " + fault;
  throw std::invalid_argument(message);
}

std::string set_param(const ParamRows& rows, std::string_view name, std::string_view text) {
  for (const auto& row : rows) {
    if (row.name != name) continue;
    if (assign(row, text)) return fault_of(row);
    return std::string(name) + ": '" + std::string(text) + "' is not " + expected(row);
  }
  return std::string(name) + ": no such parameter";
}

}  // namespace foretrack
