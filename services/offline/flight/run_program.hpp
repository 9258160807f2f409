// SPDX-License-Identifier: Apache-2.0
// Starts another program and waits for it.
#pragma once

#include <string>
#include <vector>

namespace foretrack {

/// The exit status of a program, −1 if it cannot be started or was killed.
int run_program(const std::vector<std::string>& arguments);

}  // namespace foretrack
