// SPDX-License-Identifier: Apache-2.0
#include "services/common/parameters.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace foretrack {
namespace {

using namespace rcl_interfaces::msg::ParameterValue_Constants;
using rcl_interfaces::msg::ParameterDescriptor;
using Value = Parameters::Value;

constexpr char kAtStartText[] =
    "read when the service starts; give it a parameter file (--params) and start it anew";

Value value_of(const ParamRow& row) {
  Value value;
  if (const auto* number = std::get_if<double*>(&row.value)) {
    value.type(PARAMETER_DOUBLE);
    value.double_value(**number);
  } else if (const auto* count = std::get_if<int*>(&row.value)) {
    value.type(PARAMETER_INTEGER);
    value.integer_value(**count);
  } else {
    value.type(PARAMETER_BOOL);
    value.bool_value(*std::get<bool*>(row.value));
  }
  return value;
}

// Precondition: of the row's type.
void assign(const ParamRow& row, const Value& value) {
  if (const auto* number = std::get_if<double*>(&row.value))
    **number = value.double_value();
  else if (const auto* count = std::get_if<int*>(&row.value))
    **count = static_cast<int>(value.integer_value());
  else
    *std::get<bool*>(row.value) = value.bool_value();
}

ParameterDescriptor descriptor_of(std::string_view section, const ParamRow& row, Change change) {
  ParameterDescriptor d;
  d.name(fmt::format("{}.{}", section, row.name));
  d.type(value_of(row).type());
  d.description(fmt::format("{} [{}]", row.meaning, row.unit));
  d.read_only(change == Change::kAtStart);
  if (d.read_only()) d.additional_constraints(kAtStartText);
  if (d.type() == PARAMETER_DOUBLE) {
    d.floating_point_range().resize(1);
    d.floating_point_range()[0].from_value(row.min);
    d.floating_point_range()[0].to_value(row.max);
  } else if (d.type() == PARAMETER_INTEGER) {
    d.integer_range().resize(1);
    d.integer_range()[0].from_value(static_cast<std::int64_t>(row.min));
    d.integer_range()[0].to_value(static_cast<std::int64_t>(row.max));
    d.integer_range()[0].step(1);
  }
  return d;
}

// 5 is meant as 5.0 where a number with fractions is expected.
Value as_type(const Value& value, std::uint8_t type) {
  Value result = value;
  if (type != PARAMETER_DOUBLE || value.type() != PARAMETER_INTEGER) return result;
  result.type(PARAMETER_DOUBLE);
  result.double_value(static_cast<double>(value.integer_value()));
  return result;
}

std::string fault_of_range(const ParameterDescriptor& d, const Value& value) {
  const auto text = [](const auto& number, const auto& range) {
    return fmt::format("{} is not within {} … {}", number, range.from_value(), range.to_value());
  };
  for (const auto& range : d.floating_point_range())
    if (!(value.double_value() >= range.from_value() && value.double_value() <= range.to_value()))
      return text(value.double_value(), range);
  for (const auto& range : d.integer_range())
    if (value.integer_value() < range.from_value() || value.integer_value() > range.to_value())
      return text(value.integer_value(), range);
  return {};
}

bool is_below(const std::string& name, const std::string& prefix, std::uint64_t depth) {
  if (name == prefix) return true;
  if (!prefix.empty() && !name.starts_with(prefix + '.')) return false;
  const auto begin = name.begin() + static_cast<std::ptrdiff_t>(prefix.size());
  const auto parts = static_cast<std::uint64_t>(std::count(begin, name.end(), '.'));
  return depth == 0 || parts + (prefix.empty() ? 1 : 0) <= depth;
}

}  // namespace

void Parameters::add(std::string_view section, const ParamRows& rows, Change change) {
  for (const ParamRow& row : rows) {
    Parameter parameter{descriptor_of(section, row, change), [row] { return value_of(row); }, {}};
    if (change == Change::kInFlight)
      parameter.set = [row](const Value& value) { assign(row, value); };
    add(std::move(parameter));
  }
}

void Parameters::add(Parameter parameter) {
  const std::string name = parameter.descriptor.name();
  all_[name] = std::move(parameter);
}

rcl_interfaces::msg::ListParametersResult Parameters::list(const std::vector<std::string>& prefixes,
                                                           std::uint64_t depth) const {
  rcl_interfaces::msg::ListParametersResult result;
  std::set<std::string> parents;
  const std::vector<std::string> all = {""};
  for (const auto& [name, parameter] : all_) {
    const auto& of = prefixes.empty() ? all : prefixes;
    if (std::none_of(of.begin(), of.end(), [&, &name = name](const auto& prefix) {
          return is_below(name, prefix, depth);
        }))
      continue;
    result.names().push_back(name);
    if (const auto dot = name.rfind('.'); dot != std::string::npos)
      parents.insert(name.substr(0, dot));
  }
  result.prefixes().assign(parents.begin(), parents.end());
  return result;
}

Value Parameters::get(const std::string& name) const {
  const auto it = all_.find(name);
  return it == all_.end() ? Value() : it->second.get();
}

ParameterDescriptor Parameters::describe(const std::string& name) const {
  if (const auto it = all_.find(name); it != all_.end()) return it->second.descriptor;
  ParameterDescriptor unknown;
  unknown.name(name);
  return unknown;
}

std::string Parameters::fault_of(const rcl_interfaces::msg::Parameter& wanted) const {
  const auto it = all_.find(wanted.name());
  if (it == all_.end()) return "there is no parameter '" + wanted.name() + "'";
  const auto& descriptor = it->second.descriptor;
  if (!it->second.set) return wanted.name() + " is " + descriptor.additional_constraints();
  const Value value = as_type(wanted.value(), descriptor.type());
  if (value.type() != descriptor.type()) return wanted.name() + " has another type";
  if (const auto fault = fault_of_range(descriptor, value); !fault.empty())
    return wanted.name() + ": " + fault;
  return {};
}

std::string Parameters::set(const rcl_interfaces::msg::Parameter& wanted) {
  auto fault = fault_of(wanted);
  if (!fault.empty()) return fault;
  auto& parameter = all_.at(wanted.name());
  parameter.set(as_type(wanted.value(), parameter.descriptor.type()));
  return {};
}

}  // namespace foretrack
