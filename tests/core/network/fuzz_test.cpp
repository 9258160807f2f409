// SPDX-License-Identifier: Apache-2.0
// The fuzz target in the suite, driven by seeded mutations.
#include <gtest/gtest.h>

#include "core/common/random.hpp"
#include "tests/core/network/tiny_tflite.hpp"
#include "tests/fuzz/mutate.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace foretrack {
namespace {

TEST(NetworkFile, NoBytesLeadOutsideOrCrash) {
  const auto file = testing::tiny_tflite();
  testing::Mutator mutator(1);
  for (int k = 0; k < 20000; ++k) {
    const auto bytes = mutator.mutate(file);
    LLVMFuzzerTestOneInput(bytes.data(), bytes.size());
  }
}

}  // namespace
}  // namespace foretrack
