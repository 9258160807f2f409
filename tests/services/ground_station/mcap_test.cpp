// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <lz4frame.h>

#include <fstream>

#include "services/ground_station/mcap/reader.hpp"
#include "services/ground_station/recording/recorder.hpp"
#include "services/ground_station/recording/recover.hpp"
#include "services/ground_station/recording/replay.hpp"
#include "tests/fuzz/mutate.hpp"
#include "tests/support/folder.hpp"

namespace foretrack::station::mcap {
namespace {

Bytes text(std::string_view words) {
  return {words.begin(), words.end()};
}

/// A file of three channels with some thousand messages, as bytes.
Bytes recording(int messages, bool finish = true) {
  Bytes file;
  Writer writer(
      [&](std::span<const std::uint8_t> piece) {
        file.insert(file.end(), piece.begin(), piece.end());
        return true;
      },
      "test");
  writer.add_metadata("versions", {{"foretrack", "1"}, {"dds", "2"}});
  std::vector<std::uint16_t> ids;
  for (const auto* topic : {"/a", "/b", "/c"})
    ids.push_back(writer.add_channel({topic, "cdr", "pkg/msg/T", "ros2msg", "int32 x", {}}));
  for (int i = 0; i < messages; ++i)
    writer.write(ids[static_cast<std::size_t>(i) % 3], 1000u + static_cast<std::uint64_t>(i),
                 text("message " + std::to_string(i) + std::string(1000, 'x')));
  if (finish) writer.finish();
  return file;
}

void write_file(const std::filesystem::path& path, std::span<const std::uint8_t> bytes) {
  std::ofstream(path, std::ios::binary)
      .write(reinterpret_cast<const char*>(bytes.data()),
             static_cast<std::streamsize>(bytes.size()));
}

int count(Reader& reader) {
  int messages = 0;
  while (const auto message = reader.next()) {
    const auto expected = "message " + std::to_string(messages);
    const std::string got(message->data.begin(),
                          message->data.begin() + static_cast<std::ptrdiff_t>(expected.size()));
    EXPECT_EQ(got, expected);
    EXPECT_EQ(message->log_time_ns, 1000u + static_cast<std::uint64_t>(messages));
    ++messages;
  }
  return messages;
}

TEST(Mcap, ReadsBackWhatItWrote) {
  const testing::Folder folder;
  const auto path = folder.path / "a.mcap";
  write_file(path, recording(5000));
  Reader reader(path);
  EXPECT_EQ(count(reader), 5000);
  EXPECT_TRUE(reader.complete());
  EXPECT_EQ(reader.fault(), "");
  ASSERT_EQ(reader.channels().size(), 3u);
  EXPECT_EQ(reader.channels().at(2).topic, "/b");
  EXPECT_EQ(reader.channels().at(2).schema, "int32 x");
  EXPECT_EQ(reader.metadata().at("versions").at("dds"), "2");
}

// As rosbag2 writes them: LZ4 chunks.
Bytes compressed_by_lz4(const Bytes& records) {
  Bytes file(std::begin(kMagic), std::end(kMagic));
  Encoder out(file);
  out.begin(Op::kHeader);
  out.string("ros2");
  out.string("test");
  out.end();
  Bytes packed(LZ4F_compressFrameBound(records.size(), nullptr));
  packed.resize(
      LZ4F_compressFrame(packed.data(), packed.size(), records.data(), records.size(), nullptr));
  out.begin(Op::kChunk);
  out.u64(0);
  out.u64(0);
  out.u64(records.size());
  out.u32(crc32(0, records));
  out.string("lz4");
  out.u64(packed.size());
  out.bytes(packed);
  out.end();
  out.begin(Op::kDataEnd);
  out.u32(0);
  out.end();
  return file;
}

Bytes some_records(int messages) {
  Bytes records;
  Encoder out(records);
  out.begin(Op::kSchema);
  out.u16(1);
  out.string("nav_msgs/msg/Odometry");
  out.string("ros2msg");
  out.string("");
  out.end();
  out.begin(Op::kChannel);
  out.u16(1);
  out.u16(1);
  out.string("/odom");
  out.string("cdr");
  out.strings({{"offered_qos_profiles", "- reliability: 2"}});
  out.end();
  for (int i = 0; i < messages; ++i) {
    out.begin(Op::kMessage);
    out.u16(1);
    out.u32(0);
    out.u64(1000u + static_cast<std::uint64_t>(i));
    out.u64(0);
    out.bytes(text("message " + std::to_string(i) + std::string(100, 'x')));
    out.end();
  }
  return records;
}

TEST(Mcap, ReadsChunksOfLz4AndNoBrokenOnes) {
  const testing::Folder folder;
  const auto path = folder.path / "a.mcap";
  const Bytes whole = compressed_by_lz4(some_records(500));
  write_file(path, whole);
  Reader reader(path);
  EXPECT_EQ(count(reader), 500);
  EXPECT_TRUE(reader.complete());
  for (std::size_t at = 60; at < whole.size(); at += 1 + whole.size() / 99) {
    Bytes bytes = whole;
    bytes[at] ^= 0xFF;
    write_file(path, bytes);
    Reader broken(path);
    while (broken.next()) {
    }
  }
  write_file(path, std::span(whole).first(whole.size() / 2));
  Reader cut(path);
  EXPECT_FALSE(cut.next());
  EXPECT_EQ(cut.fault(), "the file ends in the middle");
}

TEST(Recordings, OneWithoutAReadableMessageIsNamedWithTheReason) {
  const testing::Folder folder;
  const auto path = folder.path / "a.mcap";
  const auto trouble = [&](std::span<const std::uint8_t> bytes) -> std::string {
    write_file(path, bytes);
    try {
      check_recording(path);
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "";
  };
  const Bytes whole = compressed_by_lz4(some_records(9));
  EXPECT_EQ(trouble(whole), "");
  EXPECT_THAT(trouble(std::span(whole).first(80)), ::testing::HasSubstr("ends in the middle"));
  EXPECT_THAT(trouble(compressed_by_lz4(some_records(0))),
              ::testing::HasSubstr("there are none in it"));
  EXPECT_THAT(trouble(text("hello")), ::testing::HasSubstr("is not an MCAP file"));
}

TEST(Mcap, AFileThatBreaksOffAnywhereIsReadUpToItsLastWholeChunk) {
  const testing::Folder folder;
  const auto path = folder.path / "a.mcap";
  const Bytes whole = recording(5000);
  int last = 0;
  for (std::size_t size = 100; size < whole.size(); size += whole.size() / 37) {
    write_file(path, std::span(whole).first(size));
    Reader reader(path);
    const int messages = count(reader);
    EXPECT_GE(messages, last) << size;
    last = messages;
  }
  EXPECT_GT(last, 4000);
}

TEST(Mcap, StopsAtAChunkWhoseBytesWereChanged) {
  const testing::Folder folder;
  const auto path = folder.path / "a.mcap";
  Bytes bytes = recording(5000);
  bytes[300] ^= 1;  // of the first chunk
  write_file(path, bytes);
  Reader reader(path);
  EXPECT_LT(count(reader), 5000);
}

TEST(Mcap, NoByteOfAFileMakesTheReaderFail) {
  const testing::Folder folder;
  const auto path = folder.path / "a.mcap";
  const Bytes whole = recording(30);
  for (std::size_t at = sizeof kMagic; at < whole.size(); ++at) {
    Bytes bytes = whole;
    bytes[at] ^= 0xFF;
    write_file(path, bytes);
    Reader reader(path);
    while (reader.next()) {
    }
  }
  write_file(path, text("no MCAP"));
  EXPECT_THROW(Reader{path}, std::runtime_error);
}

TEST(Mcap, AWriterWhoseDiskIsFullKeepsWhatItWrote) {
  const testing::Folder folder;
  const auto path = folder.path / "a.mcap";
  Bytes file;
  Writer writer(
      [&](std::span<const std::uint8_t> piece) {
        if (file.size() + piece.size() > 60'000) return false;
        file.insert(file.end(), piece.begin(), piece.end());
        return true;
      },
      "test");
  const auto id = writer.add_channel({"/a", "cdr", "", "", "", {}});
  for (int i = 0; i < 10'000; ++i)
    writer.write(id, 1000u + static_cast<std::uint64_t>(i),
                 text("message " + std::to_string(i) + std::string(1000, 'x')));
  writer.finish();
  EXPECT_FALSE(writer.good());
  write_file(path, file);
  Reader reader(path);
  EXPECT_GT(count(reader), 1000);
}

TEST(Replay, GivesTopicsOfRosbagTheirNamesOnTheBus) {
  const testing::Folder folder;
  const auto path = folder.path / "a.mcap";
  write_file(path, compressed_by_lz4(some_records(1)));
  Stop stop;
  Channel opened;
  Replay replay({path, 100.0, false},
                Outlet{[&](const Channel& channel) { opened = channel; }, [](std::uint32_t) {},
                       [&](const auto&) { stop.request(); }});
  replay.run(stop);
  EXPECT_EQ(opened.wire, "rt/odom");
  EXPECT_EQ(opened.type, "nav_msgs::msg::dds_::Odometry_");
  EXPECT_EQ(opened.profile, "sensor");
}

TEST(Recordings, AnUnfinishedFileIsGivenItsEnd) {
  const testing::Folder folder;
  const auto path = folder.path / "a.mcap";
  const Bytes whole = recording(5000);
  write_file(path, std::span(whole).first(whole.size() * 3 / 4));
  int before = 0;
  {
    Reader reader(path);
    before = count(reader);
    EXPECT_FALSE(reader.complete());
  }
  EXPECT_EQ(recover_recordings(folder.path), 1);
  EXPECT_EQ(recover_recordings(folder.path), 0);
  Reader reader(path);
  EXPECT_EQ(count(reader), before);
  EXPECT_TRUE(reader.complete());
  EXPECT_EQ(reader.metadata().at("versions").at("foretrack"), "1");
}

TEST(Mcap, WhateverIsInAFileItIsReadToItsEndOrToWhereItBreaks) {
  const testing::Folder folder;
  const auto path = folder.path / "changed.mcap";
  const Bytes good = recording(12);
  testing::Mutator mutator(1);
  for (int k = 0; k < 1000; ++k) {
    write_file(path, mutator.mutate(good));
    try {
      Reader reader(path);
      while (reader.next()) {
      }
    } catch (const std::runtime_error&) {
      // no MCAP any more
    }
  }
}

}  // namespace
}  // namespace foretrack::station::mcap
