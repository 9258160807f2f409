// SPDX-License-Identifier: Apache-2.0
// A convolutional network as a list of layers, whatever file it came from.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace foretrack {

/// What a layer does. Names and meanings are those of TensorFlow's operators.
enum class LayerKind : std::uint8_t {
  kAdd,
  kConcatenate,  ///< along axis 1
  kConvolve,
  kConvolveDepthwise,
  kDepthToSpace,
  kMaxPool,
  kPad,  ///< with zeros
  kReshape,
  kResizeBilinear,  ///< with half-pixel centres
  kSigmoid,
};
/// What is done to a layer's output: nothing, at least 0, or between 0 and 6.
enum class Activation : std::uint8_t { kNone, kRelu, kRelu6 };

/// An array of numbers that layers read or write.
struct NetworkTensor {
  std::string name;
  std::vector<int> shape;     ///< NHWC; of weights: out, height, width, in
  std::vector<float> values;  ///< of a constant; empty: it is computed
  std::vector<int> integers;  ///< of a constant of integers
  /// The number of elements: the product of the shape.
  std::size_t size() const;
};

/// One step of a network. Tensors are given by their index in the model.
struct NetworkLayer {
  LayerKind kind = LayerKind::kAdd;
  Activation activation = Activation::kNone;
  bool same_padding = false;             ///< zeros around, so that each place of the input counts
  std::array<int, 2> stride = {1, 1};    ///< height, width
  std::array<int, 2> dilation = {1, 1};  ///< height, width
  std::array<int, 2> window = {1, 1};    ///< height, width; of pooling
  int block = 1;                         ///< side of the square that depth to space makes
  std::vector<int> inputs;               ///< of convolutions: image, weights, bias
  int output = 0;
};

/// A whole network with one input.
struct NetworkModel {
  std::vector<NetworkTensor> tensors;
  std::vector<NetworkLayer> layers;  ///< in the order in which they run
  int input = 0;                     ///< index of a tensor
  std::vector<int> outputs;          ///< indices of tensors
};

/// After it, no layer can lead outside a tensor. Throws NetworkFileError
/// (core/network/flatbuffer.hpp) in these cases:
/// - a layer's inputs do not exist, or are not computed before it;
/// - a layer's output has not the shape that follows from them;
/// - the layers together compute more than 2^27 numbers.
/// Preconditions: strides, dilations, windows and blocks are at least 1.
void check_layers(const NetworkModel& model);

}  // namespace foretrack
