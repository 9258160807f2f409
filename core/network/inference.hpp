// SPDX-License-Identifier: Apache-2.0
// Running a convolutional network: the one place that a runtime is exchanged at.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace foretrack {

struct NetworkModel;  // core/network/network_model.hpp

/// One network with its own memory. For one thread at a time. Tensors are floats in the order NHWC
/// (image, row, column, channel), the last one fastest.
class Inference {
 public:
  virtual ~Inference() = default;
  /// To be filled before run().
  virtual std::span<float> input() = 0;
  /// Works out the outputs from input(). Allocates nothing.
  virtual void run() = 0;
  /// An output of the last run; index: in the order in which the outputs were asked for. Valid
  /// until the next run.
  virtual std::span<const float> output(std::size_t index) const = 0;
};

/// Runs a model on XNNPACK, on the caller's thread. Layers that the named outputs do not need are
/// left out. The model's weights are copied. Throws std::runtime_error if an operator or its
/// arguments are not supported, std::invalid_argument if the model has no output of a name. Cost:
/// some 10 ms for 3 MB of weights.
std::unique_ptr<Inference> make_xnnpack_inference(const NetworkModel& model,
                                                  const std::vector<std::string>& outputs);

}  // namespace foretrack
