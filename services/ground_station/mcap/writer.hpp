// SPDX-License-Identifier: Apache-2.0
// Writes one MCAP file: chunks compressed by zstd, message and chunk indexes, checksums.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "services/ground_station/mcap/format.hpp"

namespace foretrack::station::mcap {

struct ChannelInfo {
  std::string topic, encoding;
  std::string schema_name, schema_encoding, schema;  // all empty: there is none
  std::map<std::string, std::string> metadata;
};

/// Whole chunks go out in one piece each, with their indexes, so that a file that ends early is
/// readable up to the last of them. The summary at the end lets readers seek.
class Writer {
 public:
  /// Appends to the file; false: it could not, and nothing of the piece is in the file.
  using Sink = std::function<bool(std::span<const std::uint8_t>)>;

  Writer(Sink sink, const std::string& library);
  ~Writer();

  /// Metadata belongs before the first message.
  void add_metadata(const std::string& name, const std::map<std::string, std::string>& values);
  /// Ids count from 1.
  std::uint16_t add_channel(const ChannelInfo& channel);
  /// Closes the chunk when it holds enough.
  void write(std::uint16_t channel, std::uint64_t log_time_ns, std::span<const std::uint8_t> data);
  /// Ends the chunk, if anything is in it.
  void flush();
  /// The summary and the end. Nothing may be written after it.
  void finish();

  /// False: the sink failed; all later calls do nothing.
  bool good() const { return good_; }
  std::uint64_t bytes() const { return bytes_; }  // in the file
  std::size_t pending_bytes() const { return chunk_.size(); }

 private:
  struct Index {
    std::uint64_t time_ns, offset;
  };
  struct Chunk {
    std::uint64_t begin_ns, end_ns, at, length, compressed, uncompressed, index_length;
    bool zstd;
    std::map<std::uint16_t, std::uint64_t> index_at;
  };
  struct Metadata {
    std::uint64_t at, length;
    std::string name;
  };
  void put(const Bytes& piece);
  void define(std::uint16_t channel);
  void write_indexes(Bytes& piece, Chunk& chunk);
  void write_statistics(Encoder& encoder);
  Bytes summary();

  struct Zstd;
  Sink sink_;
  std::unique_ptr<Zstd> zstd_;
  std::vector<Bytes> schemas_, channels_;  // as records; channels by id − 1
  std::vector<std::uint16_t> schema_of_;   // by channel id − 1; 0: none
  std::map<std::string, std::uint16_t> schema_ids_;
  std::vector<bool> schema_defined_, channel_defined_;
  Bytes chunk_;  // records, before compression
  std::map<std::uint16_t, std::vector<Index>> index_;
  std::uint64_t chunk_begin_ns_ = 0, chunk_end_ns_ = 0;
  std::vector<Chunk> chunks_;
  std::vector<Metadata> metadata_;
  std::map<std::uint16_t, std::uint64_t> counts_;
  std::map<std::uint16_t, std::uint32_t> sequence_;
  std::uint64_t first_ns_ = 0, last_ns_ = 0;
  std::uint64_t bytes_ = 0;
  std::uint32_t crc_ = 0;
  bool good_ = true;
};

}  // namespace foretrack::station::mcap
