// SPDX-License-Identifier: Apache-2.0
// Whether the program finds what it needs on this machine, before any DDS.
#pragma once

#include <string>
#include <vector>

#include "services/operator/diagnose.hpp"

namespace foretrack {

/// Shipped files, scenarios, the parameter file (empty: none), the plot's Python, shared memory.
std::vector<Finding> check_installation(const std::string& params_file);

}  // namespace foretrack
