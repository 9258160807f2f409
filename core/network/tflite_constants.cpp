// SPDX-License-Identifier: Apache-2.0
#include "core/network/tflite_constants.hpp"

#include <bit>
#include <string>

namespace foretrack {
namespace {

enum TensorType : int { kFloat32 = 0, kFloat16 = 1, kInt32 = 2 };
constexpr std::size_t kMostTensorElements = 1 << 24;
constexpr std::size_t kMostDimensions = 6;

std::vector<int> read_shape(const FlatTable& tensor, const std::string& name) {
  auto shape = tensor.values<std::int32_t>(0);
  std::size_t size = 1;
  for (const int length : shape) {
    if (length < 1 || static_cast<std::size_t>(length) > kMostTensorElements)
      throw NetworkFileError("tensor " + name + ": a side of " + std::to_string(length));
    size *= static_cast<std::size_t>(length);
    if (size > kMostTensorElements) throw NetworkFileError("tensor " + name + ": too big");
  }
  if (shape.size() > kMostDimensions) throw NetworkFileError("tensor " + name + ": too many axes");
  return {shape.begin(), shape.end()};
}

std::vector<float> read_floats(FlatTable::Bytes data, int type, const std::string& name) {
  const std::size_t width = type == kFloat16 ? 2 : 4;
  if (data.size() % width != 0) throw NetworkFileError("tensor " + name + ": half an element");
  std::vector<float> values(data.size() / width);
  if (type == kFloat32) {
    std::memcpy(values.data(), data.data(), data.size());
    return values;
  }
  for (std::size_t k = 0; k < values.size(); ++k) {
    std::uint16_t half;
    std::memcpy(&half, data.data() + 2 * k, 2);
    values[k] = float_of_half(half);
  }
  return values;
}

std::vector<int> read_indices(const FlatTable& dimension, int type_field) {
  const int kind = dimension.scalar<std::uint8_t>(type_field);
  const FlatTable values = dimension.table(type_field + 1);
  const auto widened = [](const auto& v) { return std::vector<int>(v.begin(), v.end()); };
  if (kind == 1) return widened(values.values<std::int32_t>(0));
  if (kind == 2) return widened(values.values<std::uint16_t>(0));
  if (kind == 3) return widened(values.values<std::uint8_t>(0));
  throw NetworkFileError("corrupt: sparse indices of kind " + std::to_string(kind));
}

// Compressed sparse rows: axes in order, no blocks, only the last one sparse.
std::vector<float> expand(const FlatTable& sparsity, const NetworkTensor& tensor,
                          const std::vector<float>& kept) {
  const auto fail = [&](const char* what) {
    throw NetworkFileError("tensor " + tensor.name + ": " + what);
  };
  const auto order = sparsity.values<std::int32_t>(0);
  const auto dimensions = sparsity.tables(2);
  const int axes = static_cast<int>(tensor.shape.size());
  if (axes == 0 || sparsity.values<std::int32_t>(1).size() != 0 ||
      order.size() != tensor.shape.size() || dimensions.size() != tensor.shape.size())
    fail("this kind of sparsity is not supported");
  for (int axis = 0; axis < axes; ++axis) {
    const bool sparse = dimensions[axis].scalar<std::int8_t>(0) == 1;
    if (order[axis] != axis || sparse != (axis == axes - 1))
      fail("this kind of sparsity is not supported");
    if (!sparse && dimensions[axis].scalar<std::int32_t>(1) != tensor.shape[axis])
      fail("sparse and dense sizes differ");
  }
  const auto segments = read_indices(dimensions.back(), 2);
  const auto columns = read_indices(dimensions.back(), 4);
  const int width = tensor.shape.back();
  const std::size_t rows = tensor.size() / static_cast<std::size_t>(width);
  if (segments.size() != rows + 1 || columns.size() != kept.size()) fail("sparse sizes differ");
  std::vector<float> dense(tensor.size());
  for (std::size_t row = 0; row < rows; ++row) {
    const int first = segments[row], last = segments[row + 1];
    if (first < 0 || last < first || static_cast<std::size_t>(last) > kept.size())
      fail("a sparse row leads outside");
    for (int k = first; k < last; ++k) {
      if (columns[k] < 0 || columns[k] >= width) fail("a sparse column leads outside");
      dense[row * static_cast<std::size_t>(width) + static_cast<std::size_t>(columns[k])] = kept[k];
    }
  }
  return dense;
}

}  // namespace

float float_of_half(std::uint16_t half) {
  const std::uint32_t sign = static_cast<std::uint32_t>(half & 0x8000u) << 16;
  const std::uint32_t rest = half & 0x7fffu;
  if (rest >= 0x7c00u)  // infinite or NaN
    return std::bit_cast<float>(sign | 0x7f800000u | (rest & 0x3ffu) << 13);
  // As a float with a small exponent, times 2^112: exact, denormals too.
  const float shifted = std::bit_cast<float>(rest << 13) * 0x1p112f;
  return std::bit_cast<float>(sign | std::bit_cast<std::uint32_t>(shifted));
}

NetworkTensor read_tensor(const FlatTable& table, const std::vector<FlatTable>& buffers) {
  NetworkTensor tensor;
  tensor.name = std::string(table.text(3).substr(0, 80));
  tensor.shape = read_shape(table, tensor.name);
  const int type = table.scalar<std::int8_t>(1);
  const auto buffer = table.scalar<std::uint32_t>(2);
  if (buffer >= buffers.size()) throw NetworkFileError("tensor " + tensor.name + ": no buffer");
  const FlatTable::Bytes data = buffers[buffer].bytes(0);
  if (type != kFloat32 && type != kFloat16 && type != kInt32)
    throw NetworkFileError("tensor " + tensor.name + ": elements of type " + std::to_string(type) +
                           " (32- or 16-bit floats or 32-bit integers expected)");
  if (data.empty()) return tensor;
  if (type == kInt32) {
    const auto integers = buffers[buffer].values<std::uint8_t>(0);
    tensor.integers.resize(integers.size() / 4);
    std::memcpy(tensor.integers.data(), integers.data(), 4 * tensor.integers.size());
    if (tensor.integers.size() != tensor.size())
      throw NetworkFileError("tensor " + tensor.name + ": its data has another size");
    return tensor;
  }
  tensor.values = read_floats(data, type, tensor.name);
  if (table.has(6)) tensor.values = expand(table.table(6), tensor, tensor.values);
  if (tensor.values.size() != tensor.size())
    throw NetworkFileError("tensor " + tensor.name + ": its data has another size");
  return tensor;
}

}  // namespace foretrack
