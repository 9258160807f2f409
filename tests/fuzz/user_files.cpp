// SPDX-License-Identifier: Apache-2.0
// Fuzz target: any bytes as a file that a user names; the first byte says of which kind. A loader
// takes it, or says in a std::invalid_argument what is wrong.
#include <sys/mman.h>
#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>

#include "services/files/config/load_bounds.hpp"
#include "services/files/config/load_params.hpp"
#include "services/files/config/load_scenario.hpp"
#include "services/files/config/octree_world.hpp"

namespace {

/// The bytes as a file without a place on a disk.
class MemoryFile {
 public:
  MemoryFile(const std::uint8_t* data, std::size_t size)
      : file_(memfd_create("fuzz", MFD_CLOEXEC)) {
    if (write(file_, data, size) != static_cast<ssize_t>(size)) throw std::runtime_error("memfd");
  }
  ~MemoryFile() { close(file_); }
  std::string path() const { return "/proc/self/fd/" + std::to_string(file_); }

 private:
  int file_;
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace foretrack;
  if (size == 0) return 0;
  const MemoryFile file(data + 1, size - 1);
  World world;
  try {
    switch (data[0] % 4) {
      case 0:
        load_params(file.path());
        break;
      case 1:
        load_scenario(file.path());
        break;
      case 2:
        load_bounds(file.path());
        break;
      default:
        add_octree(file.path(), true, world);
    }
  } catch (const std::invalid_argument&) {
    // as it should be
  }
  return 0;
}
