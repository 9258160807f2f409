// SPDX-License-Identifier: Apache-2.0
#include "services/ground_station/hub/video_chain.hpp"

#include <cstring>
#include <optional>

namespace foretrack::station {
namespace {

constexpr std::size_t kEncapsulationBytes = 4, kStampBytes = 8;
constexpr std::uint8_t kKeySlice = 5;  // of H.264's units

// foxglove_msgs/CompressedVideo: timestamp, frame_id, data, format. Little endian, as it is
// written.
std::optional<std::span<const std::uint8_t>> video_data(std::span<const std::uint8_t> cdr) {
  if (cdr.size() < kEncapsulationBytes || (cdr[1] & 1) == 0) return std::nullopt;
  const auto body = cdr.subspan(kEncapsulationBytes);
  std::size_t at = kStampBytes;
  const auto length = [&]() -> std::optional<std::size_t> {
    at = (at + 3) & ~std::size_t{3};
    std::uint32_t value = 0;
    if (at + sizeof value > body.size()) return std::nullopt;
    std::memcpy(&value, body.data() + at, sizeof value);
    at += sizeof value;
    if (value > body.size() - at) return std::nullopt;
    return value;
  };
  const auto frame_id = length();
  if (!frame_id) return std::nullopt;
  at += *frame_id;
  const auto data = length();
  if (!data) return std::nullopt;
  return body.subspan(at, *data);
}

// Annex B: each unit after 0 0 1; its kind in five bits.
bool has_key_slice(std::span<const std::uint8_t> data) {
  for (std::size_t i = 0; i + 3 < data.size(); ++i)
    if (data[i] == 0 && data[i + 1] == 0 && data[i + 2] == 1 && (data[i + 3] & 0x1f) == kKeySlice)
      return true;
  return false;
}

}  // namespace

bool is_ground_picture(const Channel& channel) {
  return channel.topic.find("/camera/ground/") != std::string::npos;
}

Chain chain_of(const Channel& channel, std::span<const std::uint8_t> cdr) {
  if (channel.schema_name != "foxglove_msgs/msg/CompressedVideo") return Chain::kAlone;
  const auto data = video_data(cdr);
  if (!data) return Chain::kAlone;
  return has_key_slice(*data) ? Chain::kKey : Chain::kNeedsPrevious;
}

}  // namespace foretrack::station
