// SPDX-License-Identifier: Apache-2.0
// Reads an MCAP file from its beginning to its end, or to where it breaks off.
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <map>
#include <optional>
#include <string>

#include "services/ground_station/mcap/writer.hpp"

namespace foretrack::station::mcap {

struct Message {
  std::uint16_t channel = 0;
  std::uint64_t log_time_ns = 0;
  std::span<const std::uint8_t> data;  // valid until the next call
};

/// Chunks may be uncompressed or compressed by zstd or lz4. Needs no summary, so that the file of a
/// process that was killed can be read. Nothing in the file can make it read outside of it.
class Reader {
 public:
  /// Throws std::runtime_error if the file cannot be opened or is no MCAP.
  explicit Reader(const std::filesystem::path& path);
  ~Reader();

  /// In the file's order; none: the end, or the place where the file breaks off.
  std::optional<Message> next();

  /// Those that were met so far, by id.
  const std::map<std::uint16_t, ChannelInfo>& channels() const { return channels_; }
  const std::map<std::string, std::map<std::string, std::string>>& metadata() const {
    return metadata_;
  }
  /// Why reading ended before the file's own end; empty: it did not.
  const std::string& fault() const { return fault_; }
  /// The file has its end, so it was finished.
  bool complete() const { return complete_; }

 private:
  struct Schema {
    std::string name, encoding, text;
  };
  bool read_record();
  bool open_chunk(std::span<const std::uint8_t> content);
  std::optional<Message> handle(Op op, std::span<const std::uint8_t> content);
  bool stop(const std::string& fault);

  std::ifstream file_;
  std::uint64_t size_ = 0, good_bytes_ = 0;
  Bytes record_, chunk_;
  std::optional<Decoder> in_chunk_;
  Op op_ = Op::kHeader;
  std::map<std::uint16_t, Schema> schemas_;
  std::map<std::uint16_t, ChannelInfo> channels_;
  std::map<std::string, std::map<std::string, std::string>> metadata_;
  std::string fault_;
  bool ended_ = false, complete_ = false;
};

}  // namespace foretrack::station::mcap
