// SPDX-License-Identifier: Apache-2.0
#include "services/launch/shared_memory.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <system_error>

namespace foretrack {
namespace {

namespace fs = std::filesystem;
const fs::path kFolder = "/dev/shm";
constexpr std::string_view kPrefix = "fastrtps_";
// The owner holds a lock on X_el or X_sl as long as it lives, beside the memory X itself.
constexpr std::string_view kLockSuffixes[] = {"_el", "_sl"};

std::string without_lock_suffix(std::string name) {
  for (const auto suffix : kLockSuffixes)
    if (name.ends_with(suffix)) return name.substr(0, name.size() - suffix.size());
  return name;
}

bool is_locked(const fs::path& path) {
  const int file = open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) return false;
  const bool locked = flock(file, LOCK_EX | LOCK_NB) != 0;
  close(file);
  return locked;
}

bool in_use(const std::string& name) {
  for (const auto suffix : kLockSuffixes)
    if (is_locked(kFolder / (name + std::string(suffix)))) return true;
  return false;
}

}  // namespace

std::set<std::string> mapped_shared_memory(pid_t pid) {
  std::set<std::string> names;
  std::ifstream maps(fmt::format("/proc/{}/maps", pid));
  const std::string marker = kFolder.string() + "/" + std::string(kPrefix);
  for (std::string line; std::getline(maps, line);) {
    const auto at = line.find(marker);
    if (at == std::string::npos) continue;
    const std::string name = line.substr(at + kFolder.string().size() + 1);
    names.insert(without_lock_suffix(name.substr(0, name.find(' '))));
  }
  return names;
}

void remove_shared_memory(const std::set<std::string>& names) {
  std::error_code ignored;
  for (const auto& name : names) {
    if (in_use(name)) continue;
    fs::remove(kFolder / name, ignored);
    for (const auto suffix : kLockSuffixes)
      fs::remove(kFolder / (name + std::string(suffix)), ignored);
    fs::remove(kFolder / ("sem." + name + "_mutex"), ignored);
  }
}

}  // namespace foretrack
