// SPDX-License-Identifier: Apache-2.0
#include "services/files/share/share.hpp"

#include <cstdlib>
#include <stdexcept>
#include <string>

#ifndef FORETRACK_SOURCE_DIR
#define FORETRACK_SOURCE_DIR ""
#endif

namespace foretrack {

namespace fs = std::filesystem;

std::vector<fs::path> share_folders() {
  std::vector<fs::path> folders;
  const auto add = [&](const fs::path& folder) {
    std::error_code error;
    if (!folder.empty() && fs::is_directory(folder, error)) folders.push_back(folder);
  };
  if (const char* folder = std::getenv("FORETRACK_SHARE")) add(folder);
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  const fs::path installed = program.parent_path().parent_path() / "share" / "foretrack";
  if (!error) add(installed);
  if (!fs::is_directory(installed, error)) add(FORETRACK_SOURCE_DIR);
  return folders;
}

fs::path find_share(std::string_view relative_path) {
  std::string looked;
  for (const auto& folder : share_folders()) {
    const fs::path path = folder / relative_path;
    std::error_code error;
    if (fs::exists(path, error)) return path;
    looked += "\n  " + path.string();
  }
  throw std::runtime_error("no shipped file '" + std::string(relative_path) +
                           "' (FORETRACK_SHARE names its folder); looked at:" + looked);
}

}  // namespace foretrack
