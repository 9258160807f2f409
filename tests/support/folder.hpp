// SPDX-License-Identifier: Apache-2.0
// A folder that goes with its owner.
#pragma once

#include <cstdlib>
#include <filesystem>

namespace foretrack::testing {

struct Folder {
  Folder() {
    char name[] = "/tmp/foretrack-test-XXXXXX";
    path = mkdtemp(name);
  }
  ~Folder() { std::filesystem::remove_all(path); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  std::filesystem::path path;
};

}  // namespace foretrack::testing
