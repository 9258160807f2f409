// SPDX-License-Identifier: Apache-2.0
// TensorFlow Lite files → layers.
#pragma once

#include <cstdint>
#include <span>

#include "core/network/network_model.hpp"

namespace foretrack {

/// Float networks with one input; weights may be 16-bit floats (DEQUANTIZE) and sparse (DENSIFY):
/// both become plain constants. Throws NetworkFileError that says what is corrupt or not supported,
/// whatever the bytes are. Memory: at most 512 MB. Cost: 10 ms for 3 MB.
NetworkModel read_tflite(std::span<const std::uint8_t> file);

}  // namespace foretrack
