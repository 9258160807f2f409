// SPDX-License-Identifier: Apache-2.0
// A small valid TensorFlow Lite file, written byte by byte: an 1 × 1 convolution of a 4 × 4 image
// of two channels, with half-precision weights (DEQUANTIZE) of which the zeros are left out
// (DENSIFY).
#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

namespace foretrack::testing {

using Bytes = std::vector<std::uint8_t>;

/// Writes a flatbuffer from its start to its end; offsets are filled in as their targets come.
class FlatWriter {
 public:
  /// A field is its number, its bytes, and whether the bytes are an offset to be filled in.
  struct Field {
    int number;
    Bytes bytes;
    bool offset = false;
  };
  template <class T>
  static Field scalar(int number, T value) {
    Bytes bytes(sizeof value);
    std::memcpy(bytes.data(), &value, sizeof value);
    return {number, bytes};
  }
  static Field offset(int number) { return {number, Bytes(4), true}; }

  FlatWriter() : bytes_(8) { std::memcpy(bytes_.data() + 4, "TFL3", 4); }

  /// Returns where the offsets are, in the order of the fields, for fill().
  std::vector<std::size_t> table(const std::vector<Field>& fields) {
    int most = -1;
    for (const Field& f : fields) most = std::max(most, f.number);
    const std::size_t header = bytes_.size();
    const std::size_t header_size = 4 + 2 * static_cast<std::size_t>(most + 1);
    put<std::uint16_t>(static_cast<std::uint16_t>(header_size));
    std::size_t size = 4;
    for (const Field& f : fields) size += f.bytes.size();
    put<std::uint16_t>(static_cast<std::uint16_t>(size));
    bytes_.resize(header + header_size);
    last_ = bytes_.size();
    put<std::int32_t>(static_cast<std::int32_t>(last_ - header));
    std::vector<std::size_t> offsets;
    for (const Field& f : fields) {
      set<std::uint16_t>(header + 4 + 2 * static_cast<std::size_t>(f.number),
                         static_cast<std::uint16_t>(bytes_.size() - last_));
      if (f.offset) offsets.push_back(bytes_.size());
      bytes_.insert(bytes_.end(), f.bytes.begin(), f.bytes.end());
    }
    return offsets;
  }
  /// The offset at `where` leads to what is written next.
  void fill(std::size_t where) {
    set<std::uint32_t>(where, static_cast<std::uint32_t>(bytes_.size() - where));
  }
  /// The same for a table: it starts after its header.
  void fill_table(std::size_t where) {
    set<std::uint32_t>(where, static_cast<std::uint32_t>(last_ - where));
  }
  template <class T>
  void values(std::size_t where, const std::vector<T>& list) {
    fill(where);
    put<std::uint32_t>(static_cast<std::uint32_t>(list.size()));
    for (const T& v : list) put<T>(v);
  }
  /// Returns where the offsets of the elements are.
  std::vector<std::size_t> offsets(std::size_t where, std::size_t count) {
    fill(where);
    put<std::uint32_t>(static_cast<std::uint32_t>(count));
    std::vector<std::size_t> out;
    for (std::size_t k = 0; k < count; ++k) out.push_back(bytes_.size()), put<std::uint32_t>(0);
    return out;
  }
  Bytes take() { return std::move(bytes_); }
  template <class T>
  void put(T value) {
    const std::size_t at = bytes_.size();
    bytes_.resize(at + sizeof value);
    std::memcpy(bytes_.data() + at, &value, sizeof value);
  }

 private:
  template <class T>
  void set(std::size_t at, T value) {
    std::memcpy(bytes_.data() + at, &value, sizeof value);
  }
  Bytes bytes_;
  std::size_t last_ = 0;  // where the newest table starts
};

/// Weights: out 0 = 2 × in 1, out 1 = −0.5 × in 0; bias 1 and 0.
inline Bytes tiny_tflite() {
  using F = FlatWriter;
  F w;
  const auto root =
      w.table({F::scalar<std::uint32_t>(0, 3), F::offset(1), F::offset(2), F::offset(4)});
  w.fill_table(0);
  const auto codes = w.offsets(root[0], 3);
  for (const auto& [k, code] : {std::pair{0, 124}, {1, 6}, {2, 3}}) {
    w.table({F::scalar<std::int8_t>(0, static_cast<std::int8_t>(code)),
             F::scalar<std::int32_t>(3, code)});
    w.fill_table(codes[static_cast<std::size_t>(k)]);
  }
  const auto graphs = w.offsets(root[1], 1);
  const auto graph = w.table({F::offset(0), F::offset(1), F::offset(2), F::offset(3)});
  w.fill_table(graphs[0]);
  struct Tensor {
    const char* name;
    std::vector<std::int32_t> shape;
    int type;
    std::uint32_t buffer;
    bool sparse;
  };
  const std::vector<Tensor> tensors = {
      {"image", {1, 4, 4, 2}, 0, 0, false}, {"kept", {2, 1, 1, 2}, 1, 1, true},
      {"half", {2, 1, 1, 2}, 1, 0, false},  {"weights", {2, 1, 1, 2}, 0, 0, false},
      {"bias", {2}, 0, 2, false},           {"out", {1, 4, 4, 2}, 0, 0, false}};
  const auto places = w.offsets(graph[0], tensors.size());
  for (std::size_t k = 0; k < tensors.size(); ++k) {
    const Tensor& t = tensors[k];
    std::vector<F::Field> fields = {F::offset(0),
                                    F::scalar<std::int8_t>(1, static_cast<std::int8_t>(t.type)),
                                    F::scalar<std::uint32_t>(2, t.buffer), F::offset(3)};
    if (t.sparse) fields.push_back(F::offset(6));
    const auto at = w.table(fields);
    w.fill_table(places[k]);
    w.values(at[0], t.shape);
    const std::string name = t.name;
    w.values(at[1], std::vector<char>(name.begin(), name.end()));
    if (!t.sparse) continue;
    const auto sparsity = w.table({F::offset(0), F::offset(2)});
    w.fill_table(at[2]);
    w.values<std::int32_t>(sparsity[0], {0, 1, 2, 3});
    const auto axes = w.offsets(sparsity[1], 4);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      w.table({F::scalar<std::int32_t>(1, t.shape[axis])});
      w.fill_table(axes[axis]);
    }
    const auto csr = w.table({F::scalar<std::int8_t>(0, 1), F::scalar<std::uint8_t>(2, 3),
                              F::offset(3), F::scalar<std::uint8_t>(4, 3), F::offset(5)});
    w.fill_table(axes[3]);
    for (const auto& [k2, list] :
         {std::pair{0, std::vector<std::uint8_t>{0, 1, 2}}, {1, std::vector<std::uint8_t>{1, 0}}}) {
      const auto vector = w.table({F::offset(0)});
      w.fill_table(csr[static_cast<std::size_t>(k2)]);
      w.values(vector[0], list);
    }
  }
  w.values<std::int32_t>(graph[1], {0});
  w.values<std::int32_t>(graph[2], {5});
  struct Op {
    std::uint32_t code;
    std::vector<std::int32_t> in, out;
  };
  const std::vector<Op> ops = {{0, {1}, {2}}, {1, {2}, {3}}, {2, {0, 3, 4}, {5}}};
  const auto op_places = w.offsets(graph[3], ops.size());
  for (std::size_t k = 0; k < ops.size(); ++k) {
    std::vector<F::Field> fields = {F::scalar(0, ops[k].code), F::offset(1), F::offset(2)};
    if (ops[k].code == 2) fields.push_back(F::offset(4));
    const auto at = w.table(fields);
    w.fill_table(op_places[k]);
    w.values(at[0], ops[k].in);
    w.values(at[1], ops[k].out);
    if (ops[k].code != 2) continue;
    w.table({F::scalar<std::int32_t>(1, 1), F::scalar<std::int32_t>(2, 1)});
    w.fill_table(at[2]);
  }
  const auto buffers = w.offsets(root[2], 3);
  w.table({});
  w.fill_table(buffers[0]);
  const auto half = w.table({F::offset(0)});
  w.fill_table(buffers[1]);
  w.values<std::uint8_t>(half[0], {0x00, 0x40, 0x00, 0xb8});  // 2 and −0.5
  const auto bias = w.table({F::offset(0)});
  w.fill_table(buffers[2]);
  w.values<std::uint8_t>(bias[0], {0, 0, 0x80, 0x3f, 0, 0, 0, 0});  // 1 and 0
  return w.take();
}

}  // namespace foretrack::testing
