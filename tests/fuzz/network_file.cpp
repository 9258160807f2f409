// SPDX-License-Identifier: Apache-2.0
// Fuzz target: any bytes as a network's file. What is accepted must also run.
#include <cstdint>
#include <span>
#include <stdexcept>

#include "core/network/inference.hpp"
#include "core/network/read_tflite.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace foretrack;
  try {
    const NetworkModel model = read_tflite(std::span(data, size));
    if (model.tensors[model.input].size() > 100000) return 0;
    const auto& output = model.tensors[model.outputs.front()];
    make_xnnpack_inference(model, {output.name})->run();
  } catch (const std::runtime_error&) {
  } catch (const std::invalid_argument&) {
  }
  return 0;
}
