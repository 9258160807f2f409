// SPDX-License-Identifier: Apache-2.0
#include "services/ground_station/recording/keep_within.hpp"

#include <algorithm>
#include <chrono>
#include <ratio>
#include <tuple>
#include <vector>

namespace foretrack::station {
namespace {

namespace fs = std::filesystem;

struct File {
  fs::path path;
  fs::file_time_type written;
  std::uint64_t bytes = 0;
};

// Oldest first. What cannot be looked at is left alone.
std::vector<File> recordings_in(const fs::path& folder) {
  std::vector<File> files;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    if (entry.path().extension() != ".mcap" || !entry.is_regular_file(error)) continue;
    File file{entry.path(), entry.last_write_time(error), entry.file_size(error)};
    if (!error) files.push_back(std::move(file));
  }
  std::sort(files.begin(), files.end(), [](const File& a, const File& b) {
    return std::tie(a.written, a.path) < std::tie(b.written, b.path);
  });
  return files;
}

}  // namespace

int keep_within(const fs::path& folder, const KeepLimits& limits, const std::string& now_written) {
  using Days = std::chrono::duration<double, std::ratio<86400>>;
  const auto files = recordings_in(folder);
  const auto now = fs::file_time_type::clock::now();
  std::uint64_t bytes = 0;
  for (const File& file : files) bytes += file.bytes;
  int gone = 0;
  for (const File& file : files) {
    const bool too_old = Days(now - file.written).count() > limits.days;
    if (file.path.filename() == now_written || (!too_old && bytes <= limits.bytes)) continue;
    std::error_code error;
    if (!fs::remove(file.path, error)) continue;
    bytes -= file.bytes;
    ++gone;
  }
  return gone;
}

}  // namespace foretrack::station
