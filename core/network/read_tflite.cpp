// SPDX-License-Identifier: Apache-2.0
#include "core/network/read_tflite.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <utility>

#include "core/network/flatbuffer.hpp"
#include "core/network/tflite_constants.hpp"

namespace foretrack {
namespace {

// Numbers and fields as in TensorFlow Lite's schema, version 3.
enum Operator : int {
  kOpAdd = 0,
  kOpConcatenation = 2,
  kOpConv2d = 3,
  kOpDepthwiseConv2d = 4,
  kOpDepthToSpace = 5,
  kOpDequantize = 6,
  kOpLogistic = 14,
  kOpMaxPool2d = 17,
  kOpReshape = 22,
  kOpResizeBilinear = 23,
  kOpPad = 34,
  kOpDensify = 124,
};
constexpr std::uint32_t kVersion = 3;
constexpr std::size_t kMostInConstants = 1 << 27;  // of all constants: 512 MB
constexpr int kMostStep = 64;

struct Options {
  const FlatTable* table;  // null: left out
  template <class T>
  int get(int field, int missing = 0) const {
    return table ? table->scalar<T>(field, static_cast<T>(missing)) : missing;
  }
  int step(int field, int missing = 0) const {
    const int value = get<std::int32_t>(field, missing);
    if (value < 1 || value > kMostStep)
      throw NetworkFileError("a stride or window of " + std::to_string(value));
    return value;
  }
  bool same_padding() const { return get<std::int8_t>(0) == 0; }
  Activation activation(int field) const {
    switch (get<std::int8_t>(field)) {
      case 0:
        return Activation::kNone;
      case 1:
        return Activation::kRelu;
      case 3:
        return Activation::kRelu6;
    }
    throw NetworkFileError("an activation that is not supported");
  }
};

void read_convolution(const Options& options, NetworkLayer& layer) {
  const bool depthwise = layer.kind == LayerKind::kConvolveDepthwise;
  layer.same_padding = options.same_padding();
  layer.stride = {options.step(2), options.step(1)};
  layer.activation = options.activation(depthwise ? 4 : 3);
  const int dilation = depthwise ? 5 : 4;
  layer.dilation = {options.step(dilation + 1, 1), options.step(dilation, 1)};
}

void read_max_pool(const Options& options, NetworkLayer& layer) {
  layer.same_padding = options.same_padding();
  layer.stride = {options.step(2), options.step(1)};
  layer.window = {options.step(4), options.step(3)};
  layer.activation = options.activation(5);
}

LayerKind kind_of(int code) {
  constexpr std::array<std::pair<int, LayerKind>, 10> kKinds = {
      {{kOpAdd, LayerKind::kAdd},
       {kOpConcatenation, LayerKind::kConcatenate},
       {kOpConv2d, LayerKind::kConvolve},
       {kOpDepthwiseConv2d, LayerKind::kConvolveDepthwise},
       {kOpDepthToSpace, LayerKind::kDepthToSpace},
       {kOpLogistic, LayerKind::kSigmoid},
       {kOpMaxPool2d, LayerKind::kMaxPool},
       {kOpReshape, LayerKind::kReshape},
       {kOpResizeBilinear, LayerKind::kResizeBilinear},
       {kOpPad, LayerKind::kPad}}};
  for (const auto& [known, kind] : kKinds)
    if (known == code) return kind;
  throw NetworkFileError("operator " + std::to_string(code) + " is not supported");
}

void read_options(const Options& options, NetworkLayer& layer) {
  switch (layer.kind) {
    case LayerKind::kAdd:
      layer.activation = options.activation(0);
      return;
    case LayerKind::kConcatenate:
      if (options.get<std::int32_t>(0) != 1 || options.activation(1) != Activation::kNone)
        throw NetworkFileError("a concatenation that is not along axis 1");
      return;
    case LayerKind::kConvolve:
    case LayerKind::kConvolveDepthwise:
      return read_convolution(options, layer);
    case LayerKind::kDepthToSpace:
      layer.block = options.step(0);
      return;
    case LayerKind::kMaxPool:
      return read_max_pool(options, layer);
    case LayerKind::kResizeBilinear:
      if (options.get<std::uint8_t>(2) || !options.get<std::uint8_t>(3))
        throw NetworkFileError("a resize without half-pixel centres");
      return;
    case LayerKind::kSigmoid:
    case LayerKind::kReshape:
    case LayerKind::kPad:
      return;
  }
}

std::vector<int> operator_codes(const FlatTable& file) {
  std::vector<int> codes;
  for (const FlatTable& code : file.tables(1))
    codes.push_back(std::max<int>(code.scalar<std::int8_t>(0), code.scalar<std::int32_t>(3)));
  return codes;
}

std::vector<NetworkTensor> read_tensors(const FlatTable& graph, const FlatTable& file) {
  const auto buffers = file.tables(4);
  std::vector<NetworkTensor> tensors;
  std::size_t elements = 0;
  for (const FlatTable& tensor : graph.tables(0)) {
    tensors.push_back(read_tensor(tensor, buffers));
    elements += tensors.back().values.size();
    if (elements > kMostInConstants) throw NetworkFileError("too many weights");
  }
  return tensors;
}

void check_index(int index, const NetworkModel& model) {
  if (index < 0 || static_cast<std::size_t>(index) >= model.tensors.size())
    throw NetworkFileError("corrupt: no tensor " + std::to_string(index));
}

// Weights became plain floats when they were read; what is left is to hand them on.
void pass_constant(const FlatTable& op, NetworkModel& model) {
  const auto inputs = op.values<std::int32_t>(1), outputs = op.values<std::int32_t>(2);
  if (inputs.size() != 1 || outputs.size() != 1)
    throw NetworkFileError("corrupt: a constant of several tensors");
  check_index(inputs[0], model);
  check_index(outputs[0], model);
  NetworkTensor& from = model.tensors[inputs[0]];
  NetworkTensor& to = model.tensors[outputs[0]];
  if (from.values.empty() || !to.values.empty() || from.shape != to.shape)
    throw NetworkFileError("tensor " + from.name + ": no constant that " + to.name + " could be");
  to.values = std::move(from.values);
}

NetworkLayer read_layer(const FlatTable& op, int code) {
  NetworkLayer layer;
  layer.kind = kind_of(code);
  if (op.has(4)) {
    const FlatTable options = op.table(4);
    read_options({&options}, layer);
  } else {
    read_options({nullptr}, layer);
  }
  const auto inputs = op.values<std::int32_t>(1), outputs = op.values<std::int32_t>(2);
  layer.inputs.assign(inputs.begin(), inputs.end());
  if (outputs.size() != 1) throw NetworkFileError("corrupt: a layer of several outputs");
  layer.output = outputs[0];
  return layer;
}

}  // namespace

NetworkModel read_tflite(std::span<const std::uint8_t> bytes) {
  const FlatTable file = FlatTable::root(bytes, "TFL3");
  if (file.scalar<std::uint32_t>(0) != kVersion)
    throw NetworkFileError("a TensorFlow Lite file of another version than 3");
  const auto codes = operator_codes(file);
  const auto graphs = file.tables(2);
  if (graphs.size() != 1) throw NetworkFileError("one graph expected");
  const FlatTable& graph = graphs.front();
  NetworkModel model;
  model.tensors = read_tensors(graph, file);
  for (const FlatTable& op : graph.tables(3)) {
    const auto which = op.scalar<std::uint32_t>(0);
    if (which >= codes.size()) throw NetworkFileError("corrupt: an operator without a code");
    if (codes[which] == kOpDequantize || codes[which] == kOpDensify)
      pass_constant(op, model);
    else
      model.layers.push_back(read_layer(op, codes[which]));
  }
  const auto inputs = graph.values<std::int32_t>(1), outputs = graph.values<std::int32_t>(2);
  if (inputs.size() != 1 || outputs.empty()) throw NetworkFileError("one input expected");
  model.input = inputs[0];
  model.outputs.assign(outputs.begin(), outputs.end());
  check_layers(model);
  return model;
}

}  // namespace foretrack
