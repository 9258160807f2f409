// SPDX-License-Identifier: Apache-2.0
// Constant tensors of TensorFlow Lite files as plain floats.
#pragma once

#include "core/network/flatbuffer.hpp"
#include "core/network/network_model.hpp"

namespace foretrack {

/// A tensor's name, shape and, if it is constant, its values. Throws NetworkFileError.
NetworkTensor read_tensor(const FlatTable& tensor, const std::vector<FlatTable>& buffers);

/// IEEE 754 half precision to single.
float float_of_half(std::uint16_t half);

}  // namespace foretrack
