// SPDX-License-Identifier: Apache-2.0
// Bounds-checked reading of FlatBuffers (https://flatbuffers.dev/internals): every position that a
// file names is checked before it is read, so that no file can lead outside its own bytes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <stdexcept>
#include <string_view>
#include <type_traits>
#include <vector>

namespace foretrack {

/// A file is corrupt or not supported; what() says what is wrong with it.
struct NetworkFileError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A table of a flatbuffer. It is a view: the file's bytes must outlive it. Fields are given by
/// their number in the schema. Everything throws NetworkFileError if it leads outside the file.
/// Only for little-endian machines.
class FlatTable {
 public:
  using Bytes = std::span<const std::uint8_t>;

  /// The root table of a file. Throws as well if the identifier (bytes 4 to 7) is another one.
  static FlatTable root(Bytes file, std::string_view identifier);

  /// The number in a field, or `missing` if the file leaves it out.
  template <class T>
  T scalar(int field, T missing = T{}) const {
    const std::size_t at = position(field);
    return at ? read<T>(at) : missing;
  }
  /// False if the file leaves the field out.
  bool has(int field) const { return position(field) != 0; }
  /// The table in a field. Throws if it is left out.
  FlatTable table(int field) const;
  /// The tables in a field, at most 65536. Empty if it is left out.
  std::vector<FlatTable> tables(int field) const;
  /// The bytes in a field. Empty if it is left out.
  Bytes bytes(int field) const { return vector(field, 1); }
  /// The text in a field. Empty if it is left out.
  std::string_view text(int field) const;
  /// The numbers in a field. Empty if it is left out.
  template <class T>
  std::vector<T> values(int field) const {
    static_assert(std::is_arithmetic_v<T>);
    const Bytes raw = vector(field, sizeof(T));
    std::vector<T> out(raw.size() / sizeof(T));
    if (!raw.empty()) std::memcpy(out.data(), raw.data(), raw.size());
    return out;
  }

 private:
  FlatTable(Bytes file, std::size_t start);
  template <class T>
  T read(std::size_t at) const {
    T value;
    std::memcpy(&value, inside(at, sizeof(T)).data(), sizeof(T));
    return value;
  }
  Bytes inside(std::size_t at, std::size_t count) const;
  std::size_t position(int field) const;            // of a field; 0: left out
  std::size_t follow(std::size_t at) const;         // the offset there
  Bytes vector(int field, std::size_t size) const;  // elements of that size

  Bytes file_;
  std::size_t start_ = 0;
  std::size_t fields_ = 0;  // where the table of field offsets starts
  std::size_t fields_size_ = 0;
};

}  // namespace foretrack
