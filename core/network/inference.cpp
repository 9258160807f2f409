// SPDX-License-Identifier: Apache-2.0
#include "core/network/inference.hpp"

#include <pthreadpool.h>
#include <xnnpack.h>

#include <algorithm>
#include <limits>
#include <stdexcept>

#include "core/network/network_model.hpp"

namespace foretrack {
namespace {

constexpr float kInfinite = std::numeric_limits<float>::infinity();
constexpr std::size_t kSpareFloats = XNN_EXTRA_BYTES / sizeof(float);  // that kernels may read
constexpr int kNone = -1;

void check(xnn_status status, const std::string& what) {
  if (status != xnn_status_success)
    throw std::runtime_error("XNNPACK refuses " + what + " (status " + std::to_string(status) +
                             ")");
}

// The part of a model that some outputs need.
struct Needed {
  std::vector<bool> tensor;
  std::vector<int> producer;   // layer of a tensor; kNone: input or constant
  std::vector<int> consumers;  // needed layers that read a tensor
};

Needed needed_for(const NetworkModel& model, const std::vector<int>& outputs) {
  Needed n;
  n.tensor.resize(model.tensors.size());
  n.producer.resize(model.tensors.size(), kNone);
  n.consumers.resize(model.tensors.size());
  for (const int k : outputs) n.tensor[k] = true;
  for (int l = static_cast<int>(model.layers.size()) - 1; l >= 0; --l) {
    const NetworkLayer& layer = model.layers[l];
    n.producer[layer.output] = l;
    if (!n.tensor[layer.output]) continue;
    for (const int k : layer.inputs) n.tensor[k] = true, ++n.consumers[k];
  }
  return n;
}

struct Limits {
  float min = -kInfinite, max = kInfinite;
};
Limits limits_of(Activation activation) {
  if (activation == Activation::kNone) return {};
  return {0.0f, activation == Activation::kRelu6 ? 6.0f : kInfinite};
}

// Rows before and after, columns before and after.
struct Padding {
  std::uint32_t top = 0, bottom = 0, left = 0, right = 0;
};

// Translates layers to a subgraph of XNNPACK. External values: 0 is the input, then the outputs.
class Translation {
 public:
  Translation(const NetworkModel& model, const std::vector<int>& outputs,
              const std::vector<int>& external)
      : model_(model), external_(external), needed_(needed_for(model, outputs)) {
    check(xnn_create_subgraph(static_cast<std::uint32_t>(external.size()), 0, &graph_), "a graph");
    values_.assign(model.tensors.size(), XNN_INVALID_VALUE_ID);
  }
  ~Translation() { xnn_delete_subgraph(graph_); }
  Translation(const Translation&) = delete;
  Translation& operator=(const Translation&) = delete;

  xnn_subgraph_t translate() {
    for (std::size_t k = 0; k < external_.size(); ++k)
      define(external_[k], static_cast<std::uint32_t>(k));
    for (const NetworkLayer& layer : model_.layers)
      if (needed_.tensor[layer.output] && layer.kind != LayerKind::kConcatenate && !folded(layer))
        check(add(layer), "layer " + model_.tensors[layer.output].name);
    return graph_;
  }

 private:
  std::uint32_t define(int index, std::uint32_t external = XNN_INVALID_VALUE_ID) {
    const NetworkTensor& tensor = model_.tensors[index];
    const std::vector<std::size_t> shape(tensor.shape.begin(), tensor.shape.end());
    std::uint32_t flags = 0;
    if (external != XNN_INVALID_VALUE_ID)
      flags = external == 0 ? XNN_VALUE_FLAG_EXTERNAL_INPUT : XNN_VALUE_FLAG_EXTERNAL_OUTPUT;
    const float* data = tensor.values.empty() ? nullptr : tensor.values.data();
    check(xnn_define_tensor_value(graph_, xnn_datatype_fp32, shape.size(), shape.data(), data,
                                  external, flags, &values_[index]),
          "tensor " + tensor.name);
    return values_[index];
  }
  std::uint32_t value(int index) {
    return values_[index] == XNN_INVALID_VALUE_ID ? define(index) : values_[index];
  }
  // What flows; not weights.
  std::uint32_t flow(const NetworkLayer& layer, std::size_t k = 0) {
    const int index = layer.inputs[k];
    if (index != model_.input && needed_.producer[index] == kNone)
      throw std::runtime_error("a constant as the input of a layer is not supported");
    return value(index);
  }

  // A padding of rows and columns that only convolutions without one of their own read: they do it.
  bool folded(const NetworkLayer& pad) const {
    if (pad.kind != LayerKind::kPad || is_external(pad.output)) return false;
    const auto& by = model_.tensors[pad.inputs[1]].integers;
    if (by.size() != 8 || by[0] || by[1] || by[6] || by[7]) return false;
    const auto reads = [&](const NetworkLayer& layer) {
      return needed_.tensor[layer.output] &&
             std::find(layer.inputs.begin(), layer.inputs.end(), pad.output) != layer.inputs.end();
    };
    return std::all_of(model_.layers.begin(), model_.layers.end(), [&](const auto& layer) {
      const bool convolves =
          layer.kind == LayerKind::kConvolve || layer.kind == LayerKind::kConvolveDepthwise;
      return !reads(layer) || (convolves && !layer.same_padding);
    });
  }
  bool is_external(int index) const {
    return std::find(external_.begin(), external_.end(), index) != external_.end();
  }

  xnn_status add(const NetworkLayer& layer) {
    const Limits limit = limits_of(layer.activation);
    switch (layer.kind) {
      case LayerKind::kAdd:
        return xnn_define_add2(graph_, limit.min, limit.max, flow(layer, 0), flow(layer, 1),
                               value(layer.output), 0);
      case LayerKind::kConvolve:
      case LayerKind::kConvolveDepthwise:
        return add_convolution(layer, limit);
      case LayerKind::kDepthToSpace:
        return xnn_define_depth_to_space(graph_, flow(layer), value(layer.output),
                                         static_cast<std::uint32_t>(layer.block), 0);
      case LayerKind::kMaxPool:
        return xnn_define_max_pooling_2d(graph_, 0, 0, 0, 0, u32(layer.window[0]),
                                         u32(layer.window[1]), u32(layer.stride[0]),
                                         u32(layer.stride[1]), 1, 1, limit.min, limit.max,
                                         flow(layer), value(layer.output), same(layer));
      case LayerKind::kPad:
        return add_padding(layer);
      case LayerKind::kReshape: {
        const auto& shape = model_.tensors[layer.output].shape;
        const std::vector<std::size_t> to(shape.begin(), shape.end());
        return xnn_define_static_reshape(graph_, to.size(), to.data(), flow(layer),
                                         value(layer.output), 0);
      }
      case LayerKind::kResizeBilinear: {
        const auto& shape = model_.tensors[layer.output].shape;
        return xnn_define_static_resize_bilinear_2d(graph_, static_cast<std::size_t>(shape[1]),
                                                    static_cast<std::size_t>(shape[2]), flow(layer),
                                                    value(layer.output), 0);
      }
      case LayerKind::kSigmoid:
        return xnn_define_sigmoid(graph_, flow(layer), value(layer.output), 0);
      case LayerKind::kConcatenate:
        break;
    }
    return xnn_status_unsupported_parameter;
  }

  xnn_status add_convolution(const NetworkLayer& layer, Limits limit) {
    int from = layer.inputs[0];
    Padding by;
    const int producer = needed_.producer[from];
    if (producer != kNone && folded(model_.layers[producer])) {
      const NetworkLayer& pad = model_.layers[producer];
      const auto& sizes = model_.tensors[pad.inputs[1]].integers;
      by = {u32(sizes[2]), u32(sizes[3]), u32(sizes[4]), u32(sizes[5])};
      from = pad.inputs[0];
    } else {
      flow(layer);
    }
    const auto& shape = model_.tensors[layer.inputs[1]].shape;
    const auto [down, across] = layer.stride;
    const auto [high, wide] = layer.dilation;
    if (layer.kind == LayerKind::kConvolveDepthwise)
      return xnn_define_depthwise_convolution_2d(
          graph_, by.top, by.right, by.bottom, by.left, u32(shape[1]), u32(shape[2]), u32(down),
          u32(across), u32(high), u32(wide), 1, static_cast<std::size_t>(shape[3]), limit.min,
          limit.max, value(from), value(layer.inputs[1]), value(layer.inputs[2]),
          value(layer.output), same(layer));
    return xnn_define_convolution_2d(
        graph_, by.top, by.right, by.bottom, by.left, u32(shape[1]), u32(shape[2]), u32(down),
        u32(across), u32(high), u32(wide), 1, static_cast<std::size_t>(shape[3]),
        static_cast<std::size_t>(shape[0]), limit.min, limit.max, value(from),
        value(layer.inputs[1]), value(layer.inputs[2]), value(layer.output), same(layer));
  }

  xnn_status add_padding(const NetworkLayer& layer) {
    const auto& sizes = model_.tensors[layer.inputs[1]].integers;
    std::vector<std::size_t> before, after;
    for (std::size_t k = 0; k < sizes.size(); k += 2) {
      before.push_back(static_cast<std::size_t>(sizes[k]));
      after.push_back(static_cast<std::size_t>(sizes[k + 1]));
    }
    return xnn_define_static_constant_pad(graph_, before.data(), after.data(), 0.0f, flow(layer),
                                          value(layer.output), 0);
  }
  static std::uint32_t u32(int value) { return static_cast<std::uint32_t>(value); }
  static std::uint32_t same(const NetworkLayer& layer) {
    return layer.same_padding ? XNN_FLAG_TENSORFLOW_SAME_PADDING : 0;
  }

  const NetworkModel& model_;
  const std::vector<int>& external_;
  const Needed needed_;
  xnn_subgraph_t graph_ = nullptr;
  std::vector<std::uint32_t> values_;
};

class XnnpackInference : public Inference {
 public:
  XnnpackInference(const NetworkModel& model, const std::vector<int>& outputs) {
    input_.resize(model.tensors[model.input].size() + kSpareFloats);
    std::vector<int> external = {model.input};
    std::vector<xnn_external_value> places = {{0, input_.data()}};
    for (const int k : outputs) {
      outputs_.emplace_back(model.tensors[k].size() + kSpareFloats);
      place(model, k, outputs_.back().data(), external, places);
    }
    Translation translation(model, outputs, external);
    check(xnn_create_runtime_v2(translation.translate(), nullptr, 0, &runtime_), "the network");
    const auto status = xnn_setup_runtime(runtime_, places.size(), places.data());
    if (status == xnn_status_success) return;
    xnn_delete_runtime(runtime_);
    check(status, "the network's inputs and outputs");
  }
  ~XnnpackInference() override { xnn_delete_runtime(runtime_); }
  XnnpackInference(const XnnpackInference&) = delete;
  XnnpackInference& operator=(const XnnpackInference&) = delete;

  std::span<float> input() override { return {input_.data(), input_.size() - kSpareFloats}; }
  void run() override { check(xnn_invoke_runtime(runtime_), "to run"); }
  std::span<const float> output(std::size_t index) const override {
    const auto& values = outputs_.at(index);
    return {values.data(), values.size() - kSpareFloats};
  }

 private:
  // XNNPACK of Debian 12 has no concatenation: parts are written side by side where they belong.
  static void place(const NetworkModel& model, int tensor, float* to, std::vector<int>& external,
                    std::vector<xnn_external_value>& places) {
    const auto producer = std::find_if(model.layers.begin(), model.layers.end(),
                                       [&](const auto& layer) { return layer.output == tensor; });
    if (producer == model.layers.end())
      throw std::runtime_error("an output that no layer computes");
    if (producer->kind == LayerKind::kConcatenate) {
      for (const int part : producer->inputs) {
        place(model, part, to, external, places);
        to += model.tensors[part].size();
      }
      return;
    }
    if (std::find(external.begin(), external.end(), tensor) != external.end())
      throw std::runtime_error("one tensor in two outputs is not supported");
    places.push_back({static_cast<std::uint32_t>(external.size()), to});
    external.push_back(tensor);
  }

  std::vector<float> input_;
  std::vector<std::vector<float>> outputs_;
  xnn_runtime_t runtime_ = nullptr;
};

std::vector<int> find_outputs(const NetworkModel& model, const std::vector<std::string>& names) {
  std::vector<int> found;
  for (const auto& name : names) {
    const auto at = std::find_if(model.outputs.begin(), model.outputs.end(), [&](const int k) {
      return model.tensors[static_cast<std::size_t>(k)].name == name;
    });
    if (at == model.outputs.end())
      throw std::invalid_argument("the network has no output '" + name + "'");
    found.push_back(*at);
  }
  return found;
}

}  // namespace

std::unique_ptr<Inference> make_xnnpack_inference(const NetworkModel& model,
                                                  const std::vector<std::string>& outputs) {
  check(xnn_initialize(nullptr), "to start on this machine");
  return std::make_unique<XnnpackInference>(model, find_outputs(model, outputs));
}

}  // namespace foretrack
