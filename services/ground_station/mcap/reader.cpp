// SPDX-License-Identifier: Apache-2.0
#include "services/ground_station/mcap/reader.hpp"

#include <lz4frame.h>
#include <zstd.h>

#include <algorithm>
#include <stdexcept>

namespace foretrack::station::mcap {
namespace {

constexpr std::uint64_t kMaxChunkBytes = 1u << 30;

// Whether exactly `out` was in it.
bool decompress_zstd(std::span<const std::uint8_t> in, Bytes& out) {
  const auto got = ZSTD_decompress(out.data(), out.size(), in.data(), in.size());
  return !ZSTD_isError(got) && got == out.size();
}

// MCAP has LZ4 in its frame format.
bool decompress_lz4(std::span<const std::uint8_t> in, Bytes& out) {
  LZ4F_dctx* context = nullptr;
  if (LZ4F_isError(LZ4F_createDecompressionContext(&context, LZ4F_VERSION))) return false;
  std::size_t from = 0, to = 0, left = 1;
  while (left != 0 && from < in.size()) {
    std::size_t read = in.size() - from, written = out.size() - to;
    left = LZ4F_decompress(context, out.data() + to, &written, in.data() + from, &read, nullptr);
    if (LZ4F_isError(left) || (read == 0 && written == 0)) break;
    from += read;
    to += written;
  }
  LZ4F_freeDecompressionContext(context);
  return left == 0 && to == out.size();
}

}  // namespace

Reader::Reader(const std::filesystem::path& path) : file_(path, std::ios::binary) {
  std::uint8_t magic[sizeof kMagic] = {};
  file_.read(reinterpret_cast<char*>(magic), sizeof magic);
  if (!file_ || !std::equal(std::begin(magic), std::end(magic), std::begin(kMagic)))
    throw std::runtime_error(path.string() + " is not an MCAP file");
  size_ = std::filesystem::file_size(path);
  good_bytes_ = sizeof magic;
}

Reader::~Reader() = default;

bool Reader::stop(const std::string& fault) {
  fault_ = fault;
  ended_ = true;
  return false;
}

bool Reader::read_record() {
  std::uint8_t head[kRecordHeadBytes];
  file_.read(reinterpret_cast<char*>(head), sizeof head);
  if (!file_) return stop("the file ends in the middle");
  Decoder decoder(head);
  op_ = static_cast<Op>(decoder.u8());
  const auto length = decoder.u64();
  if (length > size_ - good_bytes_) return stop("the file ends in the middle");
  record_.resize(static_cast<std::size_t>(length));
  file_.read(reinterpret_cast<char*>(record_.data()), static_cast<std::streamsize>(length));
  if (!file_) return stop("the file ends in the middle");
  return true;
}

bool Reader::open_chunk(std::span<const std::uint8_t> content) {
  Decoder decoder(content);
  decoder.u64();
  decoder.u64();
  const auto size = decoder.u64();
  const auto crc = decoder.u32();
  const auto compression = decoder.string();
  const auto records = decoder.bytes(decoder.u64());
  if (!decoder.good() || size > kMaxChunkBytes) return stop("a chunk is malformed");
  if (compression.empty()) {
    chunk_.assign(records.begin(), records.end());
  } else if (compression == "zstd" || compression == "lz4") {
    chunk_.resize(static_cast<std::size_t>(size));
    const bool whole =
        compression == "zstd" ? decompress_zstd(records, chunk_) : decompress_lz4(records, chunk_);
    if (!whole) return stop("a chunk does not decompress");
  } else {
    return stop("chunks are compressed by " + compression + ", zstd or lz4 expected");
  }
  if (crc != 0 && crc != crc32(0, chunk_)) return stop("a chunk's checksum is wrong");
  in_chunk_.emplace(chunk_);
  return true;
}

std::optional<Message> Reader::handle(Op op, std::span<const std::uint8_t> content) {
  Decoder decoder(content);
  if (op == Op::kSchema) {
    const auto id = decoder.u16();
    auto& schema = schemas_[id];
    schema.name = decoder.string();
    schema.encoding = decoder.string();
    schema.text = decoder.string();
  } else if (op == Op::kChannel) {
    const auto id = decoder.u16();
    const auto& schema = schemas_[decoder.u16()];
    auto& channel = channels_[id];
    channel = {"", "", schema.name, schema.encoding, schema.text, {}};
    channel.topic = decoder.string();
    channel.encoding = decoder.string();
    channel.metadata = decoder.strings();
  } else if (op == Op::kMetadata) {
    const auto name = decoder.string();
    metadata_[name] = decoder.strings();
  } else if (op == Op::kMessage) {
    Message message;
    message.channel = decoder.u16();
    decoder.u32();
    message.log_time_ns = decoder.u64();
    decoder.u64();
    message.data = decoder.rest();
    if (decoder.good() && channels_.contains(message.channel)) return message;
  }
  return std::nullopt;
}

std::optional<Message> Reader::next() {
  while (!ended_) {
    while (in_chunk_ && !in_chunk_->empty()) {
      const auto op = static_cast<Op>(in_chunk_->u8());
      const auto content = in_chunk_->bytes(in_chunk_->u64());
      if (!in_chunk_->good()) break;
      if (auto message = handle(op, content)) return message;
    }
    in_chunk_.reset();
    if (!read_record()) break;
    if (op_ == Op::kDataEnd || op_ == Op::kFooter) {
      complete_ = ended_ = true;
      break;
    }
    if (op_ == Op::kChunk && !open_chunk(record_)) break;
    good_bytes_ += kRecordHeadBytes + record_.size();
    if (op_ == Op::kChunk) continue;
    if (auto message = handle(op_, record_)) {
      return message;
    }
  }
  return std::nullopt;
}

}  // namespace foretrack::station::mcap
