// SPDX-License-Identifier: Apache-2.0
#include "services/operator/installation.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <filesystem>
#include <functional>

#include "services/files/config/load_params.hpp"
#include "services/files/config/load_scenario.hpp"
#include "services/files/share/share.hpp"

namespace foretrack {
namespace {

namespace fs = std::filesystem;
using Level = Finding::Level;

// Runs a check that throws if something is missing.
Finding attempt(const std::string& what, const std::function<void()>& check,
                const std::string& advice) {
  try {
    check();
    return {Level::kFine, "set-up", what, ""};
  } catch (const std::exception& error) {
    return {Level::kFault, "set-up", error.what(), advice};
  }
}

Finding python() {
  if (access("/usr/lib/python3/dist-packages/matplotlib", R_OK) == 0)
    return {Level::kFine, "set-up", "matplotlib is there, for flight.png", ""};
  return {Level::kNote, "set-up", "Without matplotlib a flight gets no picture.",
          "apt-get install python3-matplotlib"};
}

// The middleware's own shared memory; what dead processes left is only a waste.
Finding shared_memory() {
  const fs::path folder = "/dev/shm";
  std::error_code error;
  const auto space = fs::space(folder, error);
  if (error) return {Level::kNote, "set-up", "/dev/shm cannot be read.", ""};
  int files = 0;
  std::uintmax_t bytes = 0;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    if (!entry.path().filename().string().starts_with("fastrtps_")) continue;
    ++files;
    const auto size = entry.file_size(error);
    if (!error) bytes += size;
  }
  const auto text = fmt::format("/dev/shm: {} MB free, {} Fast DDS files of {} MB",
                                space.available >> 20, files, bytes >> 20);
  if (space.available > (std::uintmax_t{8} << 20)) return {Level::kFine, "set-up", text, ""};
  return {Level::kFault, "set-up", text + ": it is full.",
          "`fastdds shm clean` removes leftovers."};
}

}  // namespace

std::vector<Finding> check_installation(const std::string& params_file) {
  std::vector<Finding> findings;
  findings.push_back(attempt(
      "the shipped files are found", [] { find_share("qos/profiles.xml"); },
      "Set FORETRACK_SHARE to the folder that holds qos/ and deploy/."));
  findings.push_back(attempt(
      "the default scenario is valid", [] { load_scenario("t_intersection"); },
      "Set FORETRACK_SHARE to the folder that holds qos/ and deploy/."));
  if (!params_file.empty())
    findings.push_back(attempt(
        fmt::format("{} is valid", params_file), [&] { load_params(params_file); },
        "Every service would refuse to start with this file."));
  findings.push_back(python());
  findings.push_back(shared_memory());
  return findings;
}

}  // namespace foretrack
