// SPDX-License-Identifier: Apache-2.0
// Who ordered what, and who was refused: a line of JSON each, in a file that only grows.
#pragma once

#include <filesystem>
#include <map>
#include <string>

namespace foretrack::station {

class Audit {
 public:
  /// Creates the file, mode 0600. Throws std::runtime_error if it cannot.
  explicit Audit(const std::filesystem::path& path);
  ~Audit();
  Audit(const Audit&) = delete;
  Audit& operator=(const Audit&) = delete;

  /// Adds the time. What the disk does not take is reported once on standard error.
  void note(const std::map<std::string, std::string>& facts);

 private:
  int fd_;
};

}  // namespace foretrack::station
