// SPDX-License-Identifier: Apache-2.0
// The parameters of a service as ROS 2's tools see them: names, values, ranges, and which of them
// may change in flight.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "core/common/params.hpp"
#include "rcl_interfaces/msg/ListParametersResult.h"
#include "rcl_interfaces/msg/Parameter.h"
#include "rcl_interfaces/msg/ParameterDescriptor.h"

namespace foretrack {

/// What holds of a parameter while the vehicle flies.
enum class Change {
  kInFlight,  ///< read anew each time it is used
  kAtStart,   ///< read once: a change would not be heard, or would not be safe
};

class Parameters {
 public:
  using Value = rcl_interfaces::msg::ParameterValue;
  struct Parameter {
    rcl_interfaces::msg::ParameterDescriptor descriptor;
    std::function<Value()> get;
    std::function<void(const Value&)> set;  // none: it cannot be set
  };

  /// Names are "<section>.<row>". The rows' fields must outlive this.
  void add(std::string_view section, const ParamRows& rows, Change change);
  void add(Parameter parameter);

  /// As ROS 2 asks: all whose names begin with one of the prefixes, no deeper than so many parts
  /// behind it; no prefixes: all; depth 0: any.
  rcl_interfaces::msg::ListParametersResult list(const std::vector<std::string>& prefixes,
                                                 std::uint64_t depth) const;
  /// Of type PARAMETER_NOT_SET if there is none of that name.
  Value get(const std::string& name) const;
  /// Of that type, too, if there is none.
  rcl_interfaces::msg::ParameterDescriptor describe(const std::string& name) const;
  /// Why it cannot be set to that; empty: it can.
  std::string fault_of(const rcl_interfaces::msg::Parameter& wanted) const;
  /// Sets it, if it has no fault, which is returned.
  std::string set(const rcl_interfaces::msg::Parameter& wanted);

 private:
  std::map<std::string, Parameter> all_;
};

}  // namespace foretrack
