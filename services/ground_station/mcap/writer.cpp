// SPDX-License-Identifier: Apache-2.0
#include "services/ground_station/mcap/writer.hpp"

#include <zstd.h>

#include <algorithm>

namespace foretrack::station::mcap {
namespace {

constexpr std::size_t kChunkBytes = 1u << 20;
constexpr int kLevel = 1;  // fast: the recorder must not compete with what it records

}  // namespace

struct Writer::Zstd {
  ZSTD_CCtx* context = ZSTD_createCCtx();
  ~Zstd() { ZSTD_freeCCtx(context); }
};

Writer::Writer(Sink sink, const std::string& library)
    : sink_(std::move(sink)), zstd_(std::make_unique<Zstd>()) {
  Bytes piece(std::begin(kMagic), std::end(kMagic));
  Encoder encoder(piece);
  encoder.begin(Op::kHeader);
  encoder.string("");
  encoder.string(library);
  encoder.end();
  put(piece);
}

Writer::~Writer() = default;

void Writer::put(const Bytes& piece) {
  good_ = good_ && sink_(piece);
  if (!good_) return;
  bytes_ += piece.size();
  crc_ = crc32(crc_, piece);
}

void Writer::add_metadata(const std::string& name,
                          const std::map<std::string, std::string>& values) {
  Bytes piece;
  Encoder encoder(piece);
  encoder.begin(Op::kMetadata);
  encoder.string(name);
  encoder.strings(values);
  encoder.end();
  metadata_.push_back({bytes_, piece.size(), name});
  put(piece);
}

std::uint16_t Writer::add_channel(const ChannelInfo& info) {
  std::uint16_t schema = 0;
  if (!info.schema_name.empty()) {
    auto& known = schema_ids_[info.schema_encoding + '\n' + info.schema_name];
    if (known == 0) {
      known = static_cast<std::uint16_t>(schemas_.size() + 1);
      Encoder encoder(schemas_.emplace_back());
      encoder.begin(Op::kSchema);
      encoder.u16(known);
      encoder.string(info.schema_name);
      encoder.string(info.schema_encoding);
      encoder.string(info.schema);
      encoder.end();
      schema_defined_.push_back(false);
    }
    schema = known;
  }
  const auto id = static_cast<std::uint16_t>(channels_.size() + 1);
  Encoder encoder(channels_.emplace_back());
  encoder.begin(Op::kChannel);
  encoder.u16(id);
  encoder.u16(schema);
  encoder.string(info.topic);
  encoder.string(info.encoding);
  encoder.strings(info.metadata);
  encoder.end();
  schema_of_.push_back(schema);
  channel_defined_.push_back(false);
  return id;
}

void Writer::define(std::uint16_t channel) {
  if (channel_defined_[channel - 1u]) return;
  channel_defined_[channel - 1u] = true;
  Encoder encoder(chunk_);
  const auto schema = schema_of_[channel - 1u];
  if (schema != 0 && !schema_defined_[schema - 1u]) {
    schema_defined_[schema - 1u] = true;
    encoder.bytes(schemas_[schema - 1u]);
  }
  encoder.bytes(channels_[channel - 1u]);
}

void Writer::write(std::uint16_t channel, std::uint64_t log_time_ns,
                   std::span<const std::uint8_t> data) {
  if (!good_) return;
  if (index_.empty()) chunk_begin_ns_ = chunk_end_ns_ = log_time_ns;
  if (counts_.empty()) first_ns_ = last_ns_ = log_time_ns;
  define(channel);
  index_[channel].push_back({log_time_ns, chunk_.size()});
  Encoder encoder(chunk_);
  encoder.begin(Op::kMessage);
  encoder.u16(channel);
  encoder.u32(sequence_[channel]++);
  encoder.u64(log_time_ns);
  encoder.u64(log_time_ns);
  encoder.bytes(data);
  encoder.end();
  ++counts_[channel];
  chunk_begin_ns_ = std::min(chunk_begin_ns_, log_time_ns);
  chunk_end_ns_ = std::max(chunk_end_ns_, log_time_ns);
  first_ns_ = std::min(first_ns_, log_time_ns);
  last_ns_ = std::max(last_ns_, log_time_ns);
  if (chunk_.size() >= kChunkBytes) flush();
}

void Writer::write_indexes(Bytes& piece, Chunk& chunk) {
  const auto begin = piece.size();
  Encoder encoder(piece);
  for (const auto& [channel, entries] : index_) {
    chunk.index_at[channel] = chunk.at + piece.size();
    encoder.begin(Op::kMessageIndex);
    encoder.u16(channel);
    encoder.u32(static_cast<std::uint32_t>(entries.size() * sizeof(Index)));
    for (const auto& entry : entries) {
      encoder.u64(entry.time_ns);
      encoder.u64(entry.offset);
    }
    encoder.end();
  }
  chunk.index_length = piece.size() - begin;
}

void Writer::flush() {
  if (index_.empty() || !good_) return;
  Bytes compressed(ZSTD_compressBound(chunk_.size()));
  const auto size = ZSTD_compressCCtx(zstd_->context, compressed.data(), compressed.size(),
                                      chunk_.data(), chunk_.size(), kLevel);
  const bool is_compressed = !ZSTD_isError(size);
  if (is_compressed) compressed.resize(size);
  const auto& records = is_compressed ? compressed : chunk_;

  Chunk chunk{chunk_begin_ns_,
              chunk_end_ns_,
              bytes_,
              0,
              records.size(),
              chunk_.size(),
              0,
              is_compressed,
              {}};
  Bytes piece;
  Encoder encoder(piece);
  encoder.begin(Op::kChunk);
  encoder.u64(chunk.begin_ns);
  encoder.u64(chunk.end_ns);
  encoder.u64(chunk_.size());
  encoder.u32(crc32(0, chunk_));
  encoder.string(is_compressed ? "zstd" : "");
  encoder.u64(records.size());
  encoder.bytes(records);
  encoder.end();
  chunk.length = piece.size();
  write_indexes(piece, chunk);
  put(piece);
  chunks_.push_back(std::move(chunk));
  chunk_.clear();
  index_.clear();
}

void Writer::write_statistics(Encoder& encoder) {
  std::uint64_t messages = 0;
  for (const auto& [channel, count] : counts_) messages += count;
  encoder.begin(Op::kStatistics);
  encoder.u64(messages);
  encoder.u16(static_cast<std::uint16_t>(schemas_.size()));
  encoder.u32(static_cast<std::uint32_t>(channels_.size()));
  encoder.u32(0);  // attachments
  encoder.u32(static_cast<std::uint32_t>(metadata_.size()));
  encoder.u32(static_cast<std::uint32_t>(chunks_.size()));
  encoder.u64(first_ns_);
  encoder.u64(last_ns_);
  encoder.u32(static_cast<std::uint32_t>(counts_.size() * 10));
  for (const auto& [channel, count] : counts_) {
    encoder.u16(channel);
    encoder.u64(count);
  }
  encoder.end();
}

// Groups of records, each with its place, and the footer.
Bytes Writer::summary() {
  Bytes out, offsets;
  Encoder encoder(out), offset(offsets);
  const std::uint64_t at = bytes_;
  const auto group = [&](Op op, const auto& write_all) {
    const auto begin = out.size();
    write_all();
    if (out.size() == begin) return;
    offset.begin(Op::kSummaryOffset);
    offset.u8(static_cast<std::uint8_t>(op));
    offset.u64(at + begin);
    offset.u64(out.size() - begin);
    offset.end();
  };
  group(Op::kSchema, [&] {
    for (const auto& record : schemas_) encoder.bytes(record);
  });
  group(Op::kChannel, [&] {
    for (const auto& record : channels_) encoder.bytes(record);
  });
  group(Op::kStatistics, [&] { write_statistics(encoder); });
  group(Op::kChunkIndex, [&] {
    for (const auto& c : chunks_) {
      encoder.begin(Op::kChunkIndex);
      for (const auto value : {c.begin_ns, c.end_ns, c.at, c.length}) encoder.u64(value);
      encoder.u32(static_cast<std::uint32_t>(c.index_at.size() * 10));
      for (const auto& [channel, place] : c.index_at) {
        encoder.u16(channel);
        encoder.u64(place);
      }
      encoder.u64(c.index_length);
      encoder.string(c.zstd ? "zstd" : "");
      encoder.u64(c.compressed);
      encoder.u64(c.uncompressed);
      encoder.end();
    }
  });
  group(Op::kMetadataIndex, [&] {
    for (const auto& m : metadata_) {
      encoder.begin(Op::kMetadataIndex);
      encoder.u64(m.at);
      encoder.u64(m.length);
      encoder.string(m.name);
      encoder.end();
    }
  });
  const std::uint64_t offsets_at = at + out.size();
  encoder.bytes(offsets);
  encoder.u8(static_cast<std::uint8_t>(Op::kFooter));
  encoder.u64(20);
  encoder.u64(at);
  encoder.u64(offsets_at);
  encoder.u32(crc32(0, out));  // of all before it
  encoder.bytes(kMagic);
  return out;
}

void Writer::finish() {
  flush();
  Bytes end;
  Encoder encoder(end);
  encoder.begin(Op::kDataEnd);
  encoder.u32(crc_);
  encoder.end();
  put(end);
  put(summary());
}

}  // namespace foretrack::station::mcap
