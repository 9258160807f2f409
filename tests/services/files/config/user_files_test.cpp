// SPDX-License-Identifier: Apache-2.0
// The fuzz target in the suite, driven by seeded changes of the shipped files.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "services/files/share/share.hpp"
#include "tests/fuzz/mutate.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace foretrack {
namespace {

constexpr int kChangesOfEach = 40;

std::vector<std::uint8_t> of_kind(std::uint8_t kind, const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::vector<std::uint8_t> bytes = {kind};
  bytes.insert(bytes.end(), std::istreambuf_iterator<char>(file), {});
  return bytes;
}

std::vector<std::vector<std::uint8_t>> good_files() {
  std::vector<std::vector<std::uint8_t>> files;
  for (const auto& [kind, folder] : {std::pair{0, "deploy/params"}, {1, "deploy/scenarios"}})
    for (const auto& entry : std::filesystem::directory_iterator(find_share(folder)))
      if (entry.path().extension() == ".yaml")
        files.push_back(of_kind(static_cast<std::uint8_t>(kind), entry.path()));
  const std::string bounds = "\2fence_m: 30\naltitude_min_m: 1\naltitude_max_m: 10\n";
  files.emplace_back(bounds.begin(), bounds.end());
  const std::string octree =
      "\3# Octomap OcTree binary file\nid OcTree\nsize 3\nres 0.1\ndata\n\x55\xaa\x12\x34\x56\x78";
  files.emplace_back(octree.begin(), octree.end());
  return files;
}

TEST(UserFiles, AreLoadedOrRefusedWhateverIsInThem) {
  testing::Mutator mutator(1);
  for (const auto& file : good_files()) {
    LLVMFuzzerTestOneInput(file.data(), file.size());
    for (int k = 0; k < kChangesOfEach; ++k) {
      auto bytes = mutator.mutate(file);
      if (bytes.empty()) continue;
      bytes[0] = file[0];
      LLVMFuzzerTestOneInput(bytes.data(), bytes.size());
    }
  }
}

}  // namespace
}  // namespace foretrack
