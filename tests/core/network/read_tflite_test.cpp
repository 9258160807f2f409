// SPDX-License-Identifier: Apache-2.0
#include "core/network/read_tflite.hpp"

#include <gmock/gmock.h>

#include "core/network/flatbuffer.hpp"
#include "core/network/inference.hpp"
#include "tests/core/network/tiny_tflite.hpp"

namespace foretrack {
namespace {

using ::testing::ElementsAre;
using testing::tiny_tflite;

TEST(ReadTflite, ExpandsSparseHalfPrecisionWeights) {
  const NetworkModel model = read_tflite(tiny_tflite());
  ASSERT_EQ(model.layers.size(), 1u);
  EXPECT_EQ(model.layers[0].kind, LayerKind::kConvolve);
  EXPECT_THAT(model.tensors[3].values, ElementsAre(0.0f, 2.0f, -0.5f, 0.0f));
  EXPECT_THAT(model.tensors[4].values, ElementsAre(1.0f, 0.0f));
  EXPECT_THAT(model.outputs, ElementsAre(5));
}

TEST(ReadTflite, GivesANetworkThatRuns) {
  const auto network = make_xnnpack_inference(read_tflite(tiny_tflite()), {"out"});
  for (std::size_t k = 0; k < 32; ++k) network->input()[k] = static_cast<float>(k);
  network->run();
  for (std::size_t k = 0; k < 16; ++k) {
    EXPECT_EQ(network->output(0)[2 * k], 1.0f + 2.0f * static_cast<float>(2 * k + 1));
    EXPECT_EQ(network->output(0)[2 * k + 1], -0.5f * static_cast<float>(2 * k));
  }
}

TEST(ReadTflite, RefusesEveryTruncation) {
  const auto file = tiny_tflite();
  for (std::size_t size = 0; size + 1 < file.size(); ++size)
    EXPECT_THROW(read_tflite(std::span(file).first(size)), NetworkFileError) << size;
}

TEST(ReadTflite, SaysThatAnotherFileIsNone) {
  const std::string text = "PNG or whatever else this may be";
  try {
    read_tflite({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
    FAIL();
  } catch (const NetworkFileError& error) {
    EXPECT_STREQ(error.what(), "no 'TFL3' file");
  }
}

TEST(MakeInference, NamesAnOutputThatDoesNotExist) {
  const NetworkModel model = read_tflite(tiny_tflite());
  EXPECT_THROW(make_xnnpack_inference(model, {"nothing"}), std::invalid_argument);
}

}  // namespace
}  // namespace foretrack
