// SPDX-License-Identifier: Apache-2.0
#include "core/network/flatbuffer.hpp"

#include <bit>
#include <string>

namespace foretrack {
namespace {

static_assert(std::endian::native == std::endian::little);
constexpr std::size_t kFieldsHeader = 4;  // two sizes precede the offsets of the fields
constexpr std::size_t kMostTables = 1 << 16;

}  // namespace

FlatTable FlatTable::root(Bytes file, std::string_view identifier) {
  if (file.size() < 8 || std::memcmp(file.data() + 4, identifier.data(), 4) != 0)
    throw NetworkFileError("no '" + std::string(identifier) + "' file");
  std::uint32_t offset;
  std::memcpy(&offset, file.data(), sizeof offset);
  return FlatTable(file, offset);
}

FlatTable::FlatTable(Bytes file, std::size_t start) : file_(file), start_(start) {
  const std::int64_t fields = static_cast<std::int64_t>(start) - read<std::int32_t>(start);
  if (fields < 0) throw NetworkFileError("corrupt: a table at byte " + std::to_string(start));
  fields_ = static_cast<std::size_t>(fields);
  fields_size_ = read<std::uint16_t>(fields_);
}

FlatTable::Bytes FlatTable::inside(std::size_t at, std::size_t count) const {
  if (at > file_.size() || count > file_.size() - at)
    throw NetworkFileError("truncated or corrupt: bytes " + std::to_string(at) + " to " +
                           std::to_string(at + count) + " of " + std::to_string(file_.size()));
  return file_.subspan(at, count);
}

std::size_t FlatTable::position(int field) const {
  const std::size_t entry = kFieldsHeader + 2 * static_cast<std::size_t>(field);
  if (entry + 2 > fields_size_) return 0;
  const auto offset = read<std::uint16_t>(fields_ + entry);
  return offset ? start_ + offset : 0;
}

std::size_t FlatTable::follow(std::size_t at) const {
  return at + read<std::uint32_t>(at);
}

FlatTable::Bytes FlatTable::vector(int field, std::size_t size) const {
  const std::size_t at = position(field);
  if (!at) return {};
  const std::size_t start = follow(at);
  return inside(start + 4, size * static_cast<std::size_t>(read<std::uint32_t>(start)));
}

FlatTable FlatTable::table(int field) const {
  const std::size_t at = position(field);
  if (!at) throw NetworkFileError("corrupt: a table is missing");
  return FlatTable(file_, follow(at));
}

std::vector<FlatTable> FlatTable::tables(int field) const {
  const Bytes offsets = vector(field, 4);
  if (offsets.size() / 4 > kMostTables) throw NetworkFileError("corrupt: too many tables");
  std::vector<FlatTable> out;
  const std::size_t first = static_cast<std::size_t>(offsets.data() - file_.data());
  for (std::size_t k = 0; k < offsets.size(); k += 4)
    out.push_back(FlatTable(file_, follow(first + k)));
  return out;
}

std::string_view FlatTable::text(int field) const {
  const Bytes raw = bytes(field);
  return {reinterpret_cast<const char*>(raw.data()), raw.size()};
}

}  // namespace foretrack
