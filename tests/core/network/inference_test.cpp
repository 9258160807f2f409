// SPDX-License-Identifier: Apache-2.0
#include "core/network/inference.hpp"

#include <gtest/gtest.h>

#include "core/common/random.hpp"
#include "core/network/flatbuffer.hpp"
#include "tests/core/network/reference_layers.hpp"

namespace foretrack {
namespace {

// Models are put together tensor by tensor; every computed tensor may be asked for by its number.
class Layers : public ::testing::Test {
 protected:
  Layers() { model_.input = tensor({1, 9, 7, 4}); }

  int tensor(std::vector<int> shape) {
    NetworkTensor t;
    t.name = std::to_string(model_.tensors.size());
    t.shape = std::move(shape);
    model_.tensors.push_back(t);
    return static_cast<int>(model_.tensors.size()) - 1;
  }
  int constant(std::vector<int> shape) {
    const int k = tensor(std::move(shape));
    auto& t = model_.tensors[k];
    for (std::size_t n = 0; n < t.size(); ++n)
      t.values.push_back(static_cast<float>(random_.normal()));
    return k;
  }
  int integers(std::vector<int> shape, std::vector<int> values) {
    const int k = tensor(std::move(shape));
    model_.tensors[k].integers = std::move(values);
    return k;
  }
  int add(NetworkLayer layer, std::vector<int> inputs, std::vector<int> shape) {
    layer.inputs = std::move(inputs);
    layer.output = tensor(std::move(shape));
    model_.layers.push_back(layer);
    return layer.output;
  }
  int convolve(int from, int channels, std::vector<int> shape, NetworkLayer layer, int window) {
    const int read = model_.tensors[from].shape[3];
    layer.kind = LayerKind::kConvolve;
    return add(layer, {from, constant({channels, window, window, read}), constant({channels})},
               shape);
  }
  // Every output as by its definition.
  void compare(const std::vector<int>& outputs) {
    model_.outputs = outputs;
    check_layers(model_);
    std::vector<std::string> names;
    for (const int k : outputs) names.push_back(std::to_string(k));
    const auto network = make_xnnpack_inference(model_, names);
    std::vector<float> image;
    for (float& v : network->input()) image.push_back(v = static_cast<float>(random_.normal()));
    network->run();
    const auto truth = testing::run_by_definition(model_, image);
    for (std::size_t k = 0; k < outputs.size(); ++k) {
      const auto& expected = truth[outputs[k]];
      ASSERT_EQ(network->output(k).size(), expected.size());
      for (std::size_t n = 0; n < expected.size(); ++n)
        ASSERT_NEAR(network->output(k)[n], expected[n], 1e-4) << "output " << k << ", " << n;
    }
  }

  NetworkModel model_;
  Random random_{1};
};

TEST_F(Layers, ConvolutionsWithEveryPaddingStrideAndActivation) {
  std::vector<int> outputs;
  for (const bool same : {false, true})
    for (const int stride : {1, 2})
      for (const auto activation : {Activation::kNone, Activation::kRelu, Activation::kRelu6}) {
        NetworkLayer layer;
        layer.same_padding = same;
        layer.stride = {stride, stride};
        layer.activation = activation;
        const int high = same ? (9 - 1) / stride + 1 : (9 - 3) / stride + 1;
        const int wide = same ? (7 - 1) / stride + 1 : (7 - 3) / stride + 1;
        outputs.push_back(convolve(0, 5, {1, high, wide, 5}, layer, 3));
      }
  compare(outputs);
}

TEST_F(Layers, DepthwiseConvolutions) {
  NetworkLayer layer;
  layer.kind = LayerKind::kConvolveDepthwise;
  layer.same_padding = true;
  const int plain = add(layer, {0, constant({1, 5, 5, 4}), constant({4})}, {1, 9, 7, 4});
  layer.stride = {2, 2};
  compare({plain, add(layer, {0, constant({1, 3, 3, 4}), constant({4})}, {1, 5, 4, 4})});
}

TEST_F(Layers, PaddingsThatConvolutionsTakeOverAndPaddingsThatStay) {
  const int by = integers({4, 2}, {0, 0, 1, 2, 0, 1, 0, 0});
  const int channels = integers({4, 2}, {0, 0, 0, 0, 0, 0, 1, 3});
  const int padded = add({.kind = LayerKind::kPad, .inputs = {}}, {0, by}, {1, 12, 8, 4});
  const int convolved = convolve(padded, 3, {1, 5, 3, 3}, {.stride = {2, 2}, .inputs = {}}, 3);
  const int again = add({.kind = LayerKind::kPad, .inputs = {}}, {0, by}, {1, 12, 8, 4});
  const int used_twice = convolve(again, 3, {1, 12, 8, 3}, {.inputs = {}}, 1);
  const int pooled =
      add({.kind = LayerKind::kMaxPool, .stride = {2, 2}, .window = {2, 2}, .inputs = {}}, {again},
          {1, 6, 4, 4});
  const int deeper = add({.kind = LayerKind::kPad, .inputs = {}}, {0, channels}, {1, 9, 7, 8});
  compare({convolved, used_twice, pooled, deeper});
}

TEST_F(Layers, PoolingResizingRearrangingAddingAndSigmoid) {
  const int pooled = add({.kind = LayerKind::kMaxPool,
                          .same_padding = true,
                          .stride = {2, 2},
                          .window = {2, 2},
                          .inputs = {}},
                         {0}, {1, 5, 4, 4});
  const int resized = add({.kind = LayerKind::kResizeBilinear, .inputs = {}},
                          {pooled, integers({2}, {10, 8})}, {1, 10, 8, 4});
  const int spread =
      add({.kind = LayerKind::kDepthToSpace, .block = 2, .inputs = {}}, {pooled}, {1, 10, 8, 1});
  const int sum = add({.kind = LayerKind::kAdd, .activation = Activation::kRelu, .inputs = {}},
                      {resized, resized}, {1, 10, 8, 4});
  compare({resized, spread, sum,
           add({.kind = LayerKind::kSigmoid, .inputs = {}}, {spread}, {1, 10, 8, 1})});
}

TEST_F(Layers, JoinedOutputsAndWhatNobodyAskedFor) {
  const int first = add({.kind = LayerKind::kReshape, .inputs = {}},
                        {convolve(0, 2, {1, 9, 7, 2}, {.inputs = {}}, 1)}, {1, 63, 2});
  const int second = add({.kind = LayerKind::kReshape, .inputs = {}},
                         {convolve(0, 4, {1, 9, 7, 4}, {.inputs = {}}, 1)}, {1, 126, 2});
  const int joined =
      add({.kind = LayerKind::kConcatenate, .inputs = {}}, {first, second}, {1, 189, 2});
  add({.kind = LayerKind::kSigmoid, .inputs = {}}, {0}, {1, 9, 7, 4});  // is left out
  compare({joined});
}

TEST_F(Layers, AnOutputOfAnotherShapeIsRefused) {
  add({.kind = LayerKind::kSigmoid, .inputs = {}}, {0}, {1, 9, 7, 5});
  EXPECT_THROW(check_layers(model_), NetworkFileError);
}

TEST_F(Layers, ALayerBeforeItsInputsIsRefused) {
  const int later = tensor({1, 9, 7, 4});
  add({.kind = LayerKind::kSigmoid, .inputs = {}}, {later}, {1, 9, 7, 4});
  EXPECT_THROW(check_layers(model_), NetworkFileError);
}

}  // namespace
}  // namespace foretrack
