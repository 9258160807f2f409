// SPDX-License-Identifier: Apache-2.0
#include "services/ground_station/clip/webm.hpp"

#include <bit>

namespace foretrack::station {
namespace {

// Names of the elements (RFC 9559; EBML: RFC 8794).
enum Element : std::uint32_t {
  kEbml = 0x1A45DFA3,
  kEbmlVersion = 0x4286,
  kEbmlReadVersion = 0x42F7,
  kEbmlMaxIdLength = 0x42F2,
  kEbmlMaxSizeLength = 0x42F3,
  kDocType = 0x4282,
  kDocTypeVersion = 0x4287,
  kDocTypeReadVersion = 0x4285,
  kSegment = 0x18538067,
  kInfo = 0x1549A966,
  kTimestampScale = 0x2AD7B1,
  kDuration = 0x4489,
  kMuxingApp = 0x4D80,
  kWritingApp = 0x5741,
  kTracks = 0x1654AE6B,
  kTrackEntry = 0xAE,
  kTrackNumber = 0xD7,
  kTrackUid = 0x73C5,
  kTrackType = 0x83,
  kFlagLacing = 0x9C,
  kCodecId = 0x86,
  kVideo = 0xE0,
  kPixelWidth = 0xB0,
  kPixelHeight = 0xBA,
  kCues = 0x1C53BB6B,
  kCuePoint = 0xBB,
  kCueTime = 0xB3,
  kCueTrackPositions = 0xB7,
  kCueTrack = 0xF7,
  kCueClusterPosition = 0xF1,
  kCluster = 0x1F43B675,
  kTimestamp = 0xE7,
  kSimpleBlock = 0xA3,
};

constexpr std::uint64_t kNsOfMs = 1'000'000, kVideoTrack = 1;

std::string big_endian(std::uint64_t value, int bytes) {
  std::string out;
  for (int i = bytes - 1; i >= 0; --i) out += static_cast<char>(value >> (8 * i) & 0xFF);
  return out;
}

std::string id_of(Element element) {
  return big_endian(element, (std::bit_width(static_cast<std::uint32_t>(element)) + 7) / 8);
}

std::string element(Element name, const std::string& content) {
  return id_of(name) + '\x01' + big_endian(content.size(), 7) + content;
}

// Always eight bytes, so that a position can be known before what it points to.
std::string integer(Element name, std::uint64_t value) {
  return element(name, big_endian(value, 8));
}

std::string ebml_head() {
  return element(kEbml, integer(kEbmlVersion, 1) + integer(kEbmlReadVersion, 1) +
                            integer(kEbmlMaxIdLength, 4) + integer(kEbmlMaxSizeLength, 8) +
                            element(kDocType, "webm") + integer(kDocTypeVersion, 2) +
                            integer(kDocTypeReadVersion, 2));
}

std::string segment_info(std::int64_t duration_ms) {
  const auto duration = std::bit_cast<std::uint64_t>(static_cast<double>(duration_ms));
  return element(kInfo, integer(kTimestampScale, kNsOfMs) + integer(kDuration, duration) +
                            element(kMuxingApp, "foretrack") + element(kWritingApp, "foretrack"));
}

std::string video_tracks(int width_px, int height_px) {
  const auto video =
      element(kVideo, integer(kPixelWidth, static_cast<std::uint64_t>(width_px)) +
                          integer(kPixelHeight, static_cast<std::uint64_t>(height_px)));
  return element(kTracks,
                 element(kTrackEntry, integer(kTrackNumber, kVideoTrack) + integer(kTrackUid, 1) +
                                          integer(kTrackType, 1) + integer(kFlagLacing, 0) +
                                          element(kCodecId, "V_VP8") + video));
}

std::string cue_point(std::int64_t time_ms, std::uint64_t position) {
  return element(kCuePoint,
                 integer(kCueTime, static_cast<std::uint64_t>(time_ms)) +
                     element(kCueTrackPositions, integer(kCueTrack, kVideoTrack) +
                                                     integer(kCueClusterPosition, position)));
}

}  // namespace

void WebmWriter::add(std::int64_t time_ms, bool key, std::span<const std::uint8_t> vp8) {
  if (key) clusters_.push_back({time_ms, {}});
  Cluster& cluster = clusters_.back();
  const auto after_ms = static_cast<std::uint16_t>(time_ms - cluster.time_ms);
  std::string block = "\x81" + big_endian(after_ms, 2) + (key ? '\x80' : '\0');  // track 1
  block.append(vp8.begin(), vp8.end());
  cluster.blocks += element(kSimpleBlock, block);
  end_ms_ = time_ms;
}

std::string WebmWriter::finish(std::int64_t last_ms) const {
  const std::string front = segment_info(end_ms_ + last_ms) + video_tracks(width_px_, height_px_);
  std::vector<std::string> clusters;
  for (const auto& [time_ms, blocks] : clusters_)
    clusters.push_back(
        element(kCluster, integer(kTimestamp, static_cast<std::uint64_t>(time_ms)) + blocks));
  // Positions count from the segment's first byte.
  const auto cue_bytes = clusters.size() * cue_point(0, 0).size();
  std::uint64_t position = front.size() + element(kCues, std::string(cue_bytes, '\0')).size();
  std::string cues, all;
  for (std::size_t i = 0; i < clusters.size(); ++i) {
    cues += cue_point(clusters_[i].time_ms, position);
    position += clusters[i].size();
    all += clusters[i];
  }
  return ebml_head() + element(kSegment, front + element(kCues, cues) + all);
}

}  // namespace foretrack::station
