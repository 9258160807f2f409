// SPDX-License-Identifier: Apache-2.0
// TensorFlow Lite files → layers.
#pragma once

#include <cstdint>
#include <span>

#include "core/network/network_model.hpp"

namespace foretrack {

/// The network in a TensorFlow Lite file (schema version 3): one graph of floats with one input.
/// Weights may be 16-bit floats (DEQUANTIZE) and sparse (DENSIFY); both become plain constants. The
/// layers have been checked, see check_layers(). Whatever the bytes are, it throws nothing but
/// NetworkFileError (core/network/flatbuffer.hpp), which says what is corrupt or not supported.
/// Memory: at most 512 MB. Cost: 10 ms for 3 MB.
NetworkModel read_tflite(std::span<const std::uint8_t> file);

}  // namespace foretrack
