// SPDX-License-Identifier: Apache-2.0
#include "services/common/px4_type.hpp"

#include <algorithm>

namespace foretrack {
namespace {

using eprosima::fastrtps::rtps::SerializedPayload_t;

constexpr std::size_t kHeaderBytes = 4;
constexpr std::uint8_t kLittleEndian = 1;  // of the header's second byte; PX4 writes no other

bool same(const Px4Layout& a, const Px4Layout& b) {
  return std::equal(a.fields.begin(), a.fields.end(), b.fields.begin(), b.fields.end(),
                    [](const auto& x, const auto& y) { return x.name == y.name && x.at == y.at; });
}

// The header, and the fields in the other layout.
std::vector<std::uint8_t> translated(const Px4Layout& from, const std::uint8_t* in,
                                     const Px4Layout& to) {
  std::vector<std::uint8_t> fields, out(in, in + kHeaderBytes);
  rearrange(from, {in + kHeaderBytes, from.bytes}, to, fields);
  out.insert(out.end(), fields.begin(), fields.end());
  return out;
}

}  // namespace

Px4Type::Px4Type(const TypeOps& ops, std::string_view release)
    : CdrType(ops),
      wire_(px4_layout_of(ops.name, release)),
      ours_(px4_layout_of(ops.name, kPx4ReleaseOfIdl)) {}

bool Px4Type::is_needed(const TypeOps& ops, std::string_view release) {
  return !release.empty() &&
         !same(px4_layout_of(ops.name, release), px4_layout_of(ops.name, kPx4ReleaseOfIdl));
}

bool Px4Type::serialize(void* data, SerializedPayload_t* payload) {
  SerializedPayload_t ours(static_cast<std::uint32_t>(kHeaderBytes + ours_.bytes + 8));
  if (!CdrType::serialize(data, &ours) || ours.length < kHeaderBytes + ours_.bytes) return false;
  const auto bytes = translated(ours_, ours.data, wire_);
  if (payload->max_size < bytes.size()) return false;
  std::copy(bytes.begin(), bytes.end(), payload->data);
  payload->length = static_cast<std::uint32_t>(bytes.size());
  payload->encapsulation = ours.encapsulation;
  return true;
}

// Other bytes than the release's go on as they are, and are refused as malformed.
bool Px4Type::deserialize(SerializedPayload_t* payload, void* data) {
  if (payload->length < kHeaderBytes + wire_.bytes || payload->data[1] != kLittleEndian) {
    SerializedPayload_t nothing(1);
    return CdrType::deserialize(&nothing, data);
  }
  auto bytes = translated(wire_, payload->data, ours_);
  SerializedPayload_t ours(static_cast<std::uint32_t>(bytes.size()));
  std::copy(bytes.begin(), bytes.end(), ours.data);
  ours.length = static_cast<std::uint32_t>(bytes.size());
  return CdrType::deserialize(&ours, data);
}

std::function<uint32_t()> Px4Type::getSerializedSizeProvider(void*) {
  return [this] { return static_cast<std::uint32_t>(kHeaderBytes + wire_.bytes); };
}

}  // namespace foretrack
