// SPDX-License-Identifier: Apache-2.0
// Constant tensors of TensorFlow Lite files as plain floats.
#pragma once

#include "core/network/flatbuffer.hpp"
#include "core/network/network_model.hpp"

namespace foretrack {

/// A tensor of a TensorFlow Lite file: its name, its shape and, if it is constant, its values.
/// 16-bit floats and sparse tensors (compressed rows, along the last axis) become plain floats.
/// Throws NetworkFileError that names the tensor and what is wrong with it.
NetworkTensor read_tensor(const FlatTable& tensor, const std::vector<FlatTable>& buffers);

/// IEEE 754 half precision to single precision. Exact.
float float_of_half(std::uint16_t half);

}  // namespace foretrack
