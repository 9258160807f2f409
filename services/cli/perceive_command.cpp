// SPDX-License-Identifier: Apache-2.0
// foretrack perceive: hands over to its own program, which lies beside this one.
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <stdexcept>

#include "services/cli/commands.hpp"

namespace foretrack {

std::function<int()> prepare_perceive(CLI::App& app) {
  app.set_help_flag();
  app.prefix_command();
  return [&app]() -> int {
    const std::string program =
        std::filesystem::read_symlink("/proc/self/exe").replace_filename("foretrack_perceive");
    std::vector<std::string> arguments = app.remaining();
    std::vector<char*> list = {const_cast<char*>(program.c_str())};
    for (std::string& argument : arguments) list.push_back(argument.data());
    list.push_back(nullptr);
    ::execv(program.c_str(), list.data());
    throw std::runtime_error(program + ": " + std::strerror(errno));
  };
}

}  // namespace foretrack
