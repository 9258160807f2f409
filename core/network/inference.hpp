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

/// One network with its own memory, for one thread at a time. Tensors are float, row-major NHWC.
class Inference {
 public:
  virtual ~Inference() = default;
  /// To be filled before run().
  virtual std::span<float> input() = 0;
  /// From input() to the outputs. Allocates nothing.
  virtual void run() = 0;
  /// Of the last run, in the order in which the outputs were asked for.
  virtual std::span<const float> output(std::size_t index) const = 0;
};

/// On XNNPACK, one thread. What the named outputs do not need is left out. Throws
/// std::runtime_error if an operator or its arguments are not supported; std::invalid_argument if
/// an output is unknown.
std::unique_ptr<Inference> make_xnnpack_inference(const NetworkModel& model,
                                                  const std::vector<std::string>& outputs);

}  // namespace foretrack
