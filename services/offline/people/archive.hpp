// SPDX-License-Identifier: Apache-2.0
// Files inside a zip archive.
#pragma once

#include <filesystem>
#include <string>

namespace foretrack {

/// A zip archive, open for reading. Not thread-safe.
class Archive {
 public:
  /// Throws std::runtime_error if it cannot be read.
  explicit Archive(const std::filesystem::path& file);
  ~Archive();
  Archive(const Archive&) = delete;
  Archive& operator=(const Archive&) = delete;

  /// The bytes of one file. Throws std::runtime_error if it is missing, damaged or larger than
  /// 64 MiB.
  std::string read(const std::string& name) const;

 private:
  std::filesystem::path file_;
  void* zip_;
};

}  // namespace foretrack
