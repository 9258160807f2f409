// SPDX-License-Identifier: Apache-2.0
#include "core/network/network_model.hpp"

#include <gtest/gtest.h>

#include "core/network/flatbuffer.hpp"

namespace foretrack {
namespace {

/// A model of one layer, whose output the test knows.
struct OneLayer {
  NetworkModel model;
  std::string name;
  int add(std::vector<int> shape, bool constant = false) {
    NetworkTensor& t = model.tensors.emplace_back();
    t.name = "t" + std::to_string(model.tensors.size());
    t.shape = std::move(shape);
    if (constant) t.values.assign(t.size(), 1.0f);
    return static_cast<int>(model.tensors.size()) - 1;
  }
  int add_integers(std::vector<int> integers) {
    NetworkTensor& t = model.tensors.emplace_back();
    t.shape = {static_cast<int>(integers.size())};
    t.integers = std::move(integers);
    return static_cast<int>(model.tensors.size()) - 1;
  }
  NetworkTensor& output() {
    return model.tensors[static_cast<std::size_t>(model.layers[0].output)];
  }
};

OneLayer make(LayerKind kind, const std::vector<int>& image, const std::vector<int>& output,
              const std::vector<std::vector<int>>& constants = {},
              const std::vector<int>& integers = {}) {
  OneLayer one;
  NetworkLayer layer;
  layer.kind = kind;
  one.model.input = one.add(image);
  layer.inputs = {one.model.input};
  if (kind == LayerKind::kAdd || kind == LayerKind::kConcatenate) layer.inputs.push_back(0);
  for (const auto& shape : constants) layer.inputs.push_back(one.add(shape, true));
  if (!integers.empty()) layer.inputs.push_back(one.add_integers(integers));
  layer.output = one.add(output);
  one.model.layers = {layer};
  one.model.outputs = {layer.output};
  return one;
}

std::vector<OneLayer> one_of_each_kind() {
  using K = LayerKind;
  std::vector<OneLayer> all = {
      make(K::kAdd, {1, 4, 5, 2}, {1, 4, 5, 2}),
      make(K::kConcatenate, {1, 4, 5}, {1, 8, 5}),
      make(K::kConvolve, {1, 6, 7, 2}, {1, 4, 5, 3}, {{3, 3, 3, 2}, {3}}),
      make(K::kConvolveDepthwise, {1, 6, 7, 2}, {1, 5, 6, 2}, {{1, 2, 2, 2}, {2}}),
      make(K::kDepthToSpace, {1, 3, 4, 8}, {1, 6, 8, 2}),
      make(K::kMaxPool, {1, 6, 8, 3}, {1, 3, 4, 3}),
      make(K::kPad, {1, 3, 4, 2}, {1, 4, 7, 2}, {}, {0, 0, 1, 0, 1, 2, 0, 0}),
      make(K::kReshape, {1, 4, 5, 2}, {1, 40}),
      make(K::kResizeBilinear, {1, 3, 4, 2}, {1, 6, 8, 2}, {}, {6, 8}),
      make(K::kSigmoid, {1, 9}, {1, 9})};
  all[4].model.layers[0].block = 2;
  all[5].model.layers[0].window = all[5].model.layers[0].stride = {2, 2};
  return all;
}

TEST(CheckLayers, TakesEachKindWithTheOutputThatFollows) {
  for (const OneLayer& one : one_of_each_kind())
    EXPECT_NO_THROW(check_layers(one.model)) << static_cast<int>(one.model.layers[0].kind);
}

TEST(CheckLayers, RefusesEachKindWithAnyOtherOutput) {
  for (const OneLayer& good : one_of_each_kind()) {
    const auto axes = good.model.tensors.back().shape.size();
    for (std::size_t axis = 0; axis < axes; ++axis)
      for (const int wrong : {-1, 1}) {
        OneLayer one = good;
        one.output().shape[axis] += wrong;
        EXPECT_THROW(check_layers(one.model), NetworkFileError)
            << static_cast<int>(one.model.layers[0].kind) << " axis " << axis;
      }
  }
}

TEST(CheckLayers, RefusesEachKindWithInputsThatAreNotThere) {
  for (const OneLayer& good : one_of_each_kind())
    for (const int wrong : {-1, 100, good.model.layers[0].output}) {
      OneLayer one = good;
      one.model.layers[0].inputs[0] = wrong;
      EXPECT_THROW(check_layers(one.model), NetworkFileError);
      one = good;
      one.model.layers[0].inputs.clear();
      EXPECT_THROW(check_layers(one.model), NetworkFileError);
    }
}

// The number of places of a window on a line, counted one by one.
int places_of(int length, int window, int stride, int dilation, bool same) {
  int count = 0;
  for (int start = 0; start < length; start += stride)
    count += same || start + (window - 1) * dilation < length;
  return count;
}

TEST(CheckLayers, AWindowHasAsManyPlacesAsFit) {
  for (const int length : {5, 8, 13})
    for (const int window : {1, 2, 3, 5})
      for (const int stride : {1, 2, 3})
        for (const int dilation : {1, 2})
          for (const bool same : {false, true}) {
            const int places = places_of(length, window, stride, dilation, same);
            if (places == 0) continue;
            OneLayer one = make(LayerKind::kConvolve, {1, length, 9, 1}, {1, places, 9, 1},
                                {{1, window, 1, 1}, {1}});
            NetworkLayer& layer = one.model.layers[0];
            layer.stride = {stride, 1};
            layer.dilation = {dilation, 1};
            layer.same_padding = same;
            EXPECT_NO_THROW(check_layers(one.model))
                << length << ' ' << window << ' ' << stride << ' ' << dilation << ' ' << same;
          }
}

TEST(CheckLayers, RefusesWeightsThatDoNotFit) {
  const std::vector<int> image = {1, 6, 7, 2}, output = {1, 4, 5, 3};
  using Shapes = std::vector<std::vector<int>>;
  for (const Shapes& wrong : {Shapes{{3, 3, 3, 4}, {3}}, Shapes{{3, 3, 3, 2}, {4}},
                              Shapes{{3, 3, 2}, {3}}, Shapes{{3, 3, 3, 2}}})
    EXPECT_THROW(check_layers(make(LayerKind::kConvolve, image, output, wrong).model),
                 NetworkFileError);
  OneLayer computed = make(LayerKind::kConvolve, image, output, {{3, 3, 3, 2}, {3}});
  computed.model.tensors[1].values.clear();
  EXPECT_THROW(check_layers(computed.model), NetworkFileError);
}

TEST(CheckLayers, RefusesTwoLayersWithOneOutputAndAnOutputOfNone) {
  OneLayer twice = make(LayerKind::kSigmoid, {1, 9}, {1, 9});
  twice.model.layers.push_back(twice.model.layers[0]);
  EXPECT_THROW(check_layers(twice.model), NetworkFileError);
  OneLayer none = make(LayerKind::kSigmoid, {1, 9}, {1, 9});
  none.model.outputs = {none.add({1, 9})};
  EXPECT_THROW(check_layers(none.model), NetworkFileError);
  OneLayer no_input = make(LayerKind::kSigmoid, {1, 9}, {1, 9});
  no_input.model.input = 7;
  EXPECT_THROW(check_layers(no_input.model), NetworkFileError);
}

TEST(CheckLayers, RefusesLayersThatWouldFillTheMemory) {
  OneLayer big = make(LayerKind::kPad, {1, 4000, 4000, 1}, {1, 8000, 8000, 3}, {},
                      {0, 0, 2000, 2000, 2000, 2000, 1, 1});
  EXPECT_THROW(check_layers(big.model), NetworkFileError);
}

TEST(NetworkTensor, SizeIsTheProductOfItsShape) {
  EXPECT_EQ((NetworkTensor{.name = "", .shape = {2, 3, 5}, .values = {}, .integers = {}}.size()),
            30U);
  EXPECT_EQ(NetworkTensor().size(), 1U);
}

}  // namespace
}  // namespace foretrack
