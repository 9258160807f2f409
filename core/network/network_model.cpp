// SPDX-License-Identifier: Apache-2.0
#include "core/network/network_model.hpp"

#include "core/network/flatbuffer.hpp"

namespace foretrack {
namespace {

constexpr std::size_t kMostComputed = 1 << 27;

using Shape = std::vector<int>;

int sliding(int length, int window, int stride, int dilation, bool same) {
  const int reach = same ? 1 : (window - 1) * dilation + 1;
  return length < reach ? 0 : (length - reach) / stride + 1;
}

// What a layer's output must look like.
class ShapeRule {
 public:
  ShapeRule(const NetworkModel& model, const NetworkLayer& layer)
      : model_(model), layer_(layer), output_(model.tensors[layer.output]) {}

  Shape expected() const {
    switch (layer_.kind) {
      case LayerKind::kAdd:
        count(2);
        require(in(0).shape == in(1).shape, "two inputs of one shape");
        return in(0).shape;
      case LayerKind::kConcatenate:
        return joined();
      case LayerKind::kConvolve:
      case LayerKind::kConvolveDepthwise:
        return convolved();
      case LayerKind::kDepthToSpace:
        return rearranged();
      case LayerKind::kMaxPool:
        count(1);
        image(0);
        return slid(layer_.window[0], layer_.window[1], in(0).shape[3]);
      case LayerKind::kPad:
        return padded();
      case LayerKind::kReshape:
        require(layer_.inputs.size() <= 2 && in(0).size() == output_.size(), "as many elements");
        return output_.shape;
      case LayerKind::kResizeBilinear:
        return resized();
      case LayerKind::kSigmoid:
        count(1);
        return in(0).shape;
    }
    return {};
  }
  void require(bool holds, const char* what) const {
    if (!holds) throw NetworkFileError("layer " + output_.name + ": " + what + " expected");
  }

 private:
  const NetworkTensor& in(std::size_t k) const { return model_.tensors[layer_.inputs[k]]; }
  void count(std::size_t inputs) const {
    require(layer_.inputs.size() == inputs, "another number of inputs");
  }
  void image(std::size_t k) const {
    require(in(k).shape.size() == 4 && in(k).shape[0] == 1, "an image");
  }
  Shape slid(int height, int width, int channels) const {
    const Shape& from = in(0).shape;
    return {1, sliding(from[1], height, layer_.stride[0], layer_.dilation[0], layer_.same_padding),
            sliding(from[2], width, layer_.stride[1], layer_.dilation[1], layer_.same_padding),
            channels};
  }
  Shape convolved() const {
    require(layer_.inputs.size() == 3, "image, weights and bias");
    image(0);
    const NetworkTensor &weights = in(1), &bias = in(2);
    require(weights.shape.size() == 4 && !weights.values.empty(), "constant weights");
    const bool depthwise = layer_.kind == LayerKind::kConvolveDepthwise;
    const int channels = depthwise ? weights.shape[3] : weights.shape[0];
    const int read = depthwise ? weights.shape[0] : weights.shape[3];
    require(read == (depthwise ? 1 : in(0).shape[3]), "weights for the image's channels");
    require(!depthwise || channels == in(0).shape[3], "one weight a channel");
    require(bias.shape == Shape{channels} && !bias.values.empty(), "a bias a channel");
    return slid(weights.shape[1], weights.shape[2], channels);
  }
  Shape rearranged() const {
    count(1);
    image(0);
    const Shape& from = in(0).shape;
    const int b = layer_.block;
    require(from[3] % (b * b) == 0, "channels for the block");
    return {1, from[1] * b, from[2] * b, from[3] / (b * b)};
  }
  Shape padded() const {
    count(2);
    const Shape& from = in(0).shape;
    const auto& by = in(1).integers;
    require(by.size() == 2 * from.size(), "padding for each axis");
    Shape to = from;
    for (std::size_t axis = 0; axis < from.size(); ++axis) {
      const int before = by[2 * axis], after = by[2 * axis + 1];
      require(before >= 0 && after >= 0 && before < 4096 && after < 4096, "small paddings");
      to[axis] += before + after;
    }
    return to;
  }
  Shape resized() const {
    count(2);
    image(0);
    const auto& to = in(1).integers;
    require(to.size() == 2, "height and width");
    return {1, to[0], to[1], in(0).shape[3]};
  }
  Shape joined() const {
    require(!layer_.inputs.empty(), "inputs");
    Shape to = in(0).shape;
    require(to.size() == 3 && to[0] == 1, "rows");
    to[1] = 0;
    for (std::size_t k = 0; k < layer_.inputs.size(); ++k) {
      const Shape& part = in(k).shape;
      require(part.size() == 3 && part[0] == 1 && part[2] == to[2], "rows of one width");
      to[1] += part[1];
    }
    return to;
  }

  const NetworkModel& model_;
  const NetworkLayer& layer_;
  const NetworkTensor& output_;
};

void require_tensor(bool holds, const char* what) {
  if (!holds) throw NetworkFileError(std::string("corrupt: ") + what);
}

}  // namespace

std::size_t NetworkTensor::size() const {
  std::size_t product = 1;
  for (const int length : shape) product *= static_cast<std::size_t>(length);
  return product;
}

void check_layers(const NetworkModel& model) {
  const auto exists = [&](int k) {
    return k >= 0 && static_cast<std::size_t>(k) < model.tensors.size();
  };
  std::vector<bool> known;
  for (const auto& t : model.tensors) known.push_back(!t.values.empty() || !t.integers.empty());
  require_tensor(exists(model.input) && !known[model.input], "no input");
  known[model.input] = true;
  std::size_t computed = model.tensors[model.input].size();
  for (const NetworkLayer& layer : model.layers) {
    require_tensor(!layer.inputs.empty(), "a layer without inputs");
    for (const int k : layer.inputs)
      require_tensor(exists(k) && known[k], "a layer before its inputs");
    require_tensor(exists(layer.output) && !known[layer.output], "two layers with one output");
    const ShapeRule rule(model, layer);
    rule.require(rule.expected() == model.tensors[layer.output].shape,
                 "an output of another shape");
    known[layer.output] = true;
    computed += model.tensors[layer.output].size();
    require_tensor(computed < kMostComputed, "layers that are too big");
  }
  for (const int k : model.outputs) require_tensor(exists(k) && known[k], "no output");
}

}  // namespace foretrack
