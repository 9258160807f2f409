// SPDX-License-Identifier: Apache-2.0
#include "core/network/tflite_constants.hpp"

#include <gmock/gmock.h>

#include <cmath>

#include "tests/core/network/tiny_tflite.hpp"

namespace foretrack {
namespace {

using testing::Bytes;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using Writer = testing::FlatWriter;

TEST(FloatOfHalf, IsExactForEveryNumber) {
  for (int half = 0; half < 0x10000; ++half) {
    const int exponent = (half >> 10) & 31, fraction = half & 1023;
    const double sign = half & 0x8000 ? -1.0 : 1.0;
    const double size =
        exponent ? std::ldexp(1024 + fraction, exponent - 25) : std::ldexp(fraction, -24);
    const float value = float_of_half(static_cast<std::uint16_t>(half));
    if (exponent == 31)
      EXPECT_TRUE(fraction ? std::isnan(value) : std::isinf(value));
    else
      EXPECT_EQ(value, static_cast<float>(sign * size)) << half;
  }
}

/// A tensor whose last axis may be sparse.
struct Spec {
  std::vector<std::int32_t> shape = {2, 3};
  int type = 0;  // 0: floats of 32 bits, 1: of 16, 2: integers
  Bytes data = {};
  bool sparse = false;
  std::vector<std::int32_t> order = {0, 1};
  std::vector<std::uint8_t> segments = {0, 1, 3}, columns = {2, 0, 1};
  std::uint8_t kind = 3;  // of the indices: 3 is bytes
  std::int32_t rows = 2;  // of the axis that is not sparse
  std::uint32_t buffer = 0;
};

template <class T>
Bytes bytes_of(const std::vector<T>& values) {
  Bytes bytes(values.size() * sizeof(T));
  std::memcpy(bytes.data(), values.data(), bytes.size());
  return bytes;
}

Bytes tensor_file(const Spec& spec) {
  Writer w;
  std::vector<Writer::Field> fields = {
      Writer::offset(0), Writer::scalar<std::int8_t>(1, static_cast<std::int8_t>(spec.type)),
      Writer::scalar<std::uint32_t>(2, spec.buffer), Writer::offset(3)};
  if (spec.sparse) fields.push_back(Writer::offset(6));
  const auto at = w.table(fields);
  w.fill_table(0);
  w.values(at[0], spec.shape);
  w.values(at[1], std::vector<char>{'w'});
  if (!spec.sparse) return w.take();
  const auto sparsity = w.table({Writer::offset(0), Writer::offset(2)});
  w.fill_table(at[2]);
  w.values(sparsity[0], spec.order);
  const auto axes = w.offsets(sparsity[1], 2);
  w.table({Writer::scalar<std::int32_t>(1, spec.rows)});
  w.fill_table(axes[0]);
  const auto csr = w.table({Writer::scalar<std::int8_t>(0, 1), Writer::scalar(2, spec.kind),
                            Writer::offset(3), Writer::scalar(4, spec.kind), Writer::offset(5)});
  w.fill_table(axes[1]);
  for (const auto& [place, list] :
       {std::pair{csr[0], spec.segments}, std::pair{csr[1], spec.columns}}) {
    const auto vector = w.table({Writer::offset(0)});
    w.fill_table(place);
    w.values(vector[0], list);
  }
  return w.take();
}

NetworkTensor read(const Spec& spec) {
  Writer w;
  const auto at = w.table({Writer::offset(0)});
  w.fill_table(0);
  w.values(at[0], spec.data);
  const Bytes file = tensor_file(spec), buffer = w.take();
  return read_tensor(FlatTable::root(file, "TFL3"), {FlatTable::root(buffer, "TFL3")});
}

std::string fault_of(const Spec& spec) {
  try {
    read(spec);
    return "none";
  } catch (const NetworkFileError& error) {
    return error.what();
  }
}

Spec sparse() {
  return {.data = bytes_of<float>({1.0f, 2.0f, 3.0f}), .sparse = true};
}

TEST(ReadTensor, TakesFloatsHalvesAndIntegers) {
  const std::vector<float> six = {0.5f, -1.0f, 2.0f, 0.0f, 4.0f, 1e9f};
  const NetworkTensor floats = read({.data = bytes_of(six)});
  EXPECT_EQ(floats.name, "w");
  EXPECT_THAT(floats.shape, ElementsAre(2, 3));
  EXPECT_EQ(floats.values, six);
  EXPECT_THAT(read({.shape = {2}, .type = 1, .data = {0x00, 0x40, 0x00, 0xb8}}).values,
              ElementsAre(2.0f, -0.5f));
  const NetworkTensor integers = read({.shape = {2}, .type = 2, .data = bytes_of<int>({7, -9})});
  EXPECT_THAT(integers.integers, ElementsAre(7, -9));
  EXPECT_TRUE(integers.values.empty());
}

TEST(ReadTensor, WithoutDataATensorIsComputed) {
  const NetworkTensor tensor = read({});
  EXPECT_TRUE(tensor.values.empty());
  EXPECT_EQ(tensor.size(), 6U);
}

TEST(ReadTensor, SparseRowsAreFilledUpWithZeros) {
  EXPECT_THAT(read(sparse()).values, ElementsAre(0.0f, 0.0f, 1.0f, 2.0f, 3.0f, 0.0f));
}

TEST(ReadTensor, SaysWhatIsWrongWithASparseTensor) {
  const auto fault = [](auto&& change) {
    Spec spec = sparse();
    change(spec);
    return fault_of(spec);
  };
  EXPECT_THAT(fault([](Spec& s) { s.columns = {2, 0, 3}; }), HasSubstr("column leads outside"));
  EXPECT_THAT(fault([](Spec& s) { s.segments = {0, 1, 4}; }), HasSubstr("row leads outside"));
  EXPECT_THAT(fault([](Spec& s) { s.segments = {0, 2, 1}; }), HasSubstr("row leads outside"));
  EXPECT_THAT(fault([](Spec& s) { s.segments = {0, 3}; }), HasSubstr("sparse sizes differ"));
  EXPECT_THAT(fault([](Spec& s) { s.columns = {2, 0}; }), HasSubstr("sparse sizes differ"));
  EXPECT_THAT(fault([](Spec& s) { s.order = {1, 0}; }), HasSubstr("not supported"));
  EXPECT_THAT(fault([](Spec& s) { s.rows = 3; }), HasSubstr("sizes differ"));
  EXPECT_THAT(fault([](Spec& s) { s.kind = 9; }), HasSubstr("sparse indices of kind 9"));
}

TEST(ReadTensor, SaysWhatIsWrongWithItsShapeTypeAndSize) {
  const Bytes two = bytes_of<float>({1.0f, 2.0f});
  EXPECT_THAT(fault_of({.shape = {2, 0}}), HasSubstr("a side of 0"));
  EXPECT_THAT(fault_of({.shape = {-1}}), HasSubstr("a side of -1"));
  EXPECT_THAT(fault_of({.shape = {5000, 5000}}), HasSubstr("too big"));
  EXPECT_THAT(fault_of({.shape = {1, 1, 1, 1, 1, 1, 1}}), HasSubstr("too many axes"));
  EXPECT_THAT(fault_of({.shape = {2}, .type = 9, .data = two}), HasSubstr("of type 9"));
  EXPECT_THAT(fault_of({.shape = {3}, .data = two}), HasSubstr("another size"));
  EXPECT_THAT(fault_of({.shape = {3}, .type = 2, .data = two}), HasSubstr("another size"));
  EXPECT_THAT(fault_of({.shape = {2}, .data = {1, 2, 3}}), HasSubstr("half an element"));
  EXPECT_THAT(fault_of({.buffer = 3}), HasSubstr("no buffer"));
}

}  // namespace
}  // namespace foretrack
