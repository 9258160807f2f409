// SPDX-License-Identifier: Apache-2.0
#include "services/ground_station/mcap/format.hpp"

#include <array>

namespace foretrack::station::mcap {
namespace {

constexpr std::array<std::uint32_t, 256> make_table() {
  std::array<std::uint32_t, 256> table{};
  for (std::uint32_t i = 0; i < 256; ++i) {
    std::uint32_t value = i;
    for (int bit = 0; bit < 8; ++bit) value = (value >> 1) ^ (value & 1 ? 0xEDB88320u : 0u);
    table[i] = value;
  }
  return table;
}

constexpr auto kTable = make_table();

}  // namespace

std::uint32_t crc32(std::uint32_t crc, std::span<const std::uint8_t> data) {
  crc = ~crc;
  for (const auto byte : data) crc = (crc >> 8) ^ kTable[(crc ^ byte) & 0xFF];
  return ~crc;
}

void Encoder::string(std::string_view text) {
  u32(static_cast<std::uint32_t>(text.size()));
  out_.insert(out_.end(), text.begin(), text.end());
}

void Encoder::strings(const std::map<std::string, std::string>& pairs) {
  std::size_t size = 0;
  for (const auto& [key, value] : pairs) size += 8 + key.size() + value.size();
  u32(static_cast<std::uint32_t>(size));
  for (const auto& [key, value] : pairs) {
    string(key);
    string(value);
  }
}

void Encoder::begin(Op op) {
  u8(static_cast<std::uint8_t>(op));
  length_at_ = out_.size();
  u64(0);
}

void Encoder::end() {
  const std::uint64_t length = out_.size() - length_at_ - 8;
  for (std::size_t i = 0; i < 8; ++i)
    out_[length_at_ + i] = static_cast<std::uint8_t>(length >> (8 * i));
}

std::span<const std::uint8_t> Decoder::bytes(std::uint64_t size) {
  if (size > data_.size()) {
    good_ = false;
    data_ = {};
    return {};
  }
  const auto taken = data_.first(static_cast<std::size_t>(size));
  data_ = data_.subspan(static_cast<std::size_t>(size));
  return taken;
}

std::string Decoder::string() {
  const auto text = bytes(u32());
  return {text.begin(), text.end()};
}

std::map<std::string, std::string> Decoder::strings() {
  Decoder inside(bytes(u32()));
  std::map<std::string, std::string> pairs;
  while (!inside.empty() && inside.good()) {
    auto key = inside.string();
    pairs[std::move(key)] = inside.string();
  }
  good_ = good_ && inside.good();
  return pairs;
}

}  // namespace foretrack::station::mcap
