// SPDX-License-Identifier: Apache-2.0
// The layers of a network by their definitions, one output element at a time.
#pragma once

#include <algorithm>
#include <cmath>

#include "core/network/network_model.hpp"

namespace foretrack::testing {

/// Computes every layer in order. `image` is the input; returns the values of all tensors.
inline std::vector<std::vector<double>> run_by_definition(const NetworkModel& model,
                                                          const std::vector<float>& image) {
  std::vector<std::vector<double>> values;
  for (const auto& t : model.tensors) values.emplace_back(t.values.begin(), t.values.end());
  values[model.input].assign(image.begin(), image.end());
  const auto limited = [](double v, Activation a) {
    if (a == Activation::kNone) return v;
    return std::clamp(v, 0.0, a == Activation::kRelu6 ? 6.0 : 1e30);
  };
  for (const NetworkLayer& layer : model.layers) {
    const auto tensor = [&](int k) -> const NetworkTensor& { return model.tensors[k]; };
    const auto in = [&](std::size_t k) -> const std::vector<double>& {
      return values[layer.inputs[k]];
    };
    auto& out = values[layer.output];
    const auto& to = tensor(layer.output).shape;
    const auto& from = tensor(layer.inputs[0]).shape;
    out.assign(tensor(layer.output).size(), 0.0);
    const auto pixel = [&](const std::vector<double>& data, int y, int x, int c, double outside) {
      if (y < 0 || x < 0 || y >= from[1] || x >= from[2]) return outside;
      return data[((y * from[2] + x) * from[3] + c)];
    };
    // Rows (axis 1) or columns (2) before the image with SAME padding.
    const auto before = [&](int axis, int window) {
      if (!layer.same_padding) return 0;
      const int k = axis - 1;
      const int stride = layer.stride[k];
      const int reach = (window - 1) * layer.dilation[k] + 1;
      return std::max(0, (to[axis] - 1) * stride + reach - from[axis]) / 2;
    };
    const auto each = [&](const auto& element) {
      for (int y = 0, k = 0; y < to[1]; ++y)
        for (int x = 0; x < to[2]; ++x)
          for (int c = 0; c < to[3]; ++c, ++k) out[k] = limited(element(y, x, c), layer.activation);
    };
    switch (layer.kind) {
      case LayerKind::kAdd:
        for (std::size_t k = 0; k < out.size(); ++k)
          out[k] = limited(in(0)[k] + in(1)[k], layer.activation);
        break;
      case LayerKind::kSigmoid:
        for (std::size_t k = 0; k < out.size(); ++k) out[k] = 1.0 / (1.0 + std::exp(-in(0)[k]));
        break;
      case LayerKind::kReshape:
        out = in(0);
        break;
      case LayerKind::kConcatenate: {
        std::size_t k = 0;
        for (std::size_t part = 0; part < layer.inputs.size(); ++part)
          for (const double v : in(part)) out[k++] = v;
        break;
      }
      case LayerKind::kConvolve:
      case LayerKind::kConvolveDepthwise: {
        const bool deep = layer.kind == LayerKind::kConvolveDepthwise;
        const auto& w = tensor(layer.inputs[1]).shape;
        const int top = before(1, w[1]), left = before(2, w[2]);
        each([&](int y, int x, int c) {
          double sum = in(2)[c];
          for (int r = 0; r < w[1]; ++r)
            for (int s = 0; s < w[2]; ++s)
              for (int i = 0; i < (deep ? 1 : w[3]); ++i) {
                const int weight =
                    deep ? (r * w[2] + s) * w[3] + c : ((c * w[1] + r) * w[2] + s) * w[3] + i;
                sum += in(1)[weight] *
                       pixel(in(0), y * layer.stride[0] - top + r * layer.dilation[0],
                             x * layer.stride[1] - left + s * layer.dilation[1], deep ? c : i, 0.0);
              }
          return sum;
        });
        break;
      }
      case LayerKind::kMaxPool: {
        const int top = before(1, layer.window[0]), left = before(2, layer.window[1]);
        each([&](int y, int x, int c) {
          double most = -1e30;
          for (int r = 0; r < layer.window[0]; ++r)
            for (int s = 0; s < layer.window[1]; ++s)
              most = std::max(most, pixel(in(0), y * layer.stride[0] - top + r,
                                          x * layer.stride[1] - left + s, c, -1e30));
          return most;
        });
        break;
      }
      case LayerKind::kPad: {
        const auto& by = tensor(layer.inputs[1]).integers;
        each([&](int y, int x, int c) {
          const int channel = c - by[6];
          if (channel < 0 || channel >= from[3]) return 0.0;
          return pixel(in(0), y - by[2], x - by[4], channel, 0.0);
        });
        break;
      }
      case LayerKind::kDepthToSpace:
        each([&](int y, int x, int c) {
          const int b = layer.block;
          return pixel(in(0), y / b, x / b, ((y % b) * b + x % b) * to[3] + c, 0.0);
        });
        break;
      case LayerKind::kResizeBilinear:
        each([&](int y, int x, int c) {
          const double v = std::clamp((y + 0.5) * from[1] / to[1] - 0.5, 0.0, from[1] - 1.0);
          const double u = std::clamp((x + 0.5) * from[2] / to[2] - 0.5, 0.0, from[2] - 1.0);
          const int r = static_cast<int>(v), s = static_cast<int>(u);
          const int r1 = std::min(r + 1, from[1] - 1), s1 = std::min(s + 1, from[2] - 1);
          const double a = pixel(in(0), r, s, c, 0.0), b = pixel(in(0), r, s1, c, 0.0);
          const double d = pixel(in(0), r1, s, c, 0.0), e = pixel(in(0), r1, s1, c, 0.0);
          return (1 - (v - r)) * ((1 - (u - s)) * a + (u - s) * b) +
                 (v - r) * ((1 - (u - s)) * d + (u - s) * e);
        });
        break;
    }
  }
  return values;
}

}  // namespace foretrack::testing
