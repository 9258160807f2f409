// SPDX-License-Identifier: Apache-2.0
// In a build without DDS.
#include "services/cli/commands.hpp"

namespace foretrack {

std::vector<Command> service_commands() {
  return {};
}

}  // namespace foretrack
