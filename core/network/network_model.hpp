// SPDX-License-Identifier: Apache-2.0
// A convolutional network as a list of layers, whatever file it came from.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace foretrack {

enum class LayerKind : std::uint8_t {
  kAdd,
  kConcatenate,  // along axis 1
  kConvolve,
  kConvolveDepthwise,
  kDepthToSpace,
  kMaxPool,
  kPad,  // with zeros
  kReshape,
  kResizeBilinear,  // with half-pixel centres
  kSigmoid,
};
enum class Activation : std::uint8_t { kNone, kRelu, kRelu6 };

struct NetworkTensor {
  std::string name;
  std::vector<int> shape;     // NHWC; weights: out, height, width, in
  std::vector<float> values;  // of constants; empty: computed
  std::vector<int> integers;  // of integer constants
  std::size_t size() const;   // the product of the shape
};

struct NetworkLayer {
  LayerKind kind = LayerKind::kAdd;
  Activation activation = Activation::kNone;
  bool same_padding = false;
  std::array<int, 2> stride = {1, 1};  // height, width
  std::array<int, 2> dilation = {1, 1};
  std::array<int, 2> window = {1, 1};  // of pooling
  int block = 1;                       // of depth to space
  std::vector<int> inputs;             // tensors; convolutions: image, weights, bias
  int output = 0;
};

/// Layers are in the order in which they run.
struct NetworkModel {
  std::vector<NetworkTensor> tensors;
  std::vector<NetworkLayer> layers;
  int input = 0;
  std::vector<int> outputs;
  const NetworkTensor& tensor_of(int index) const { return tensors[index]; }
};

/// Throws NetworkFileError if a layer's inputs do not exist or are not computed before it, or if
/// its output has not the shape that follows from them: after it no layer can lead outside a
/// tensor.
void check_layers(const NetworkModel& model);

}  // namespace foretrack
