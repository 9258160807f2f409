// SPDX-License-Identifier: Apache-2.0
#include "core/network/flatbuffer.hpp"

#include <gmock/gmock.h>

#include "tests/core/network/tiny_tflite.hpp"

namespace foretrack {
namespace {

using testing::Bytes;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using Writer = testing::FlatWriter;

// A root table of a number (field 0), a text (2), numbers (3), two tables (4) and one table (6).
Bytes file() {
  Writer w;
  const auto at = w.table({Writer::scalar<std::int32_t>(0, -7), Writer::offset(2),
                           Writer::offset(3), Writer::offset(4), Writer::offset(6)});
  w.fill_table(0);
  w.values(at[0], std::vector<char>{'l', 'e', 'f', 't'});
  w.values<std::int16_t>(at[1], {3, -1, 500});
  const auto places = w.offsets(at[2], 2);
  for (const int k : {0, 1}) {
    w.table({Writer::scalar<std::uint8_t>(1, static_cast<std::uint8_t>(40 + k))});
    w.fill_table(places[static_cast<std::size_t>(k)]);
  }
  w.table({Writer::scalar<float>(0, 2.5f)});
  w.fill_table(at[3]);
  return w.take();
}

template <class T>
void put(Bytes& bytes, std::size_t at, T value) {
  std::memcpy(bytes.data() + at, &value, sizeof value);
}

std::uint32_t root_of(const Bytes& bytes) {
  std::uint32_t at;
  std::memcpy(&at, bytes.data(), sizeof at);
  return at;
}

TEST(FlatTable, ReadsWhatWasWritten) {
  const Bytes bytes = file();
  const FlatTable root = FlatTable::root(bytes, "TFL3");
  EXPECT_EQ(root.scalar<std::int32_t>(0), -7);
  EXPECT_EQ(root.text(2), "left");
  EXPECT_THAT(root.values<std::int16_t>(3), ElementsAre(3, -1, 500));
  const auto tables = root.tables(4);
  ASSERT_EQ(tables.size(), 2U);
  EXPECT_EQ(tables[0].scalar<std::uint8_t>(1), 40);
  EXPECT_EQ(tables[1].scalar<std::uint8_t>(1), 41);
  EXPECT_EQ(root.table(6).scalar<float>(0), 2.5f);
}

TEST(FlatTable, WhatIsLeftOutIsMissingOrEmpty) {
  const Bytes bytes = file();
  const FlatTable root = FlatTable::root(bytes, "TFL3");
  for (const int field : {1, 5, 7, 1000}) {  // between others, and beyond the last one
    EXPECT_FALSE(root.has(field));
    EXPECT_EQ(root.scalar<std::int32_t>(field, 12), 12);
    EXPECT_THAT(root.text(field), IsEmpty());
    EXPECT_THAT(root.values<float>(field), IsEmpty());
    EXPECT_THAT(root.tables(field), IsEmpty());
    EXPECT_THROW(root.table(field), NetworkFileError);
  }
  EXPECT_TRUE(root.has(0));
}

TEST(FlatTable, AnotherIdentifierIsRefused) {
  const Bytes bytes = file();
  EXPECT_THROW(FlatTable::root(bytes, "TFL2"), NetworkFileError);
  EXPECT_THROW(FlatTable::root(std::span(bytes).first(7), "TFL3"), NetworkFileError);
}

// Reads all that the file has, so that each position in it is followed.
void read_all(const Bytes& bytes) {
  const FlatTable root = FlatTable::root(bytes, "TFL3");
  root.scalar<std::int32_t>(0);
  root.text(2);
  root.values<std::int16_t>(3);
  for (const FlatTable& table : root.tables(4)) table.scalar<std::uint8_t>(1);
  root.table(6).scalar<float>(0);
}

TEST(FlatTable, NoPositionLeadsOutsideTheFile) {
  const Bytes good = file();
  read_all(good);
  for (std::size_t at = 0; at + 4 <= good.size(); ++at)
    for (const std::uint32_t wild : {0xffffffffU, 0x7fffffffU, 0x80000000U, 0x10000U}) {
      Bytes bytes = good;
      put(bytes, at, wild);
      try {
        read_all(bytes);  // under AddressSanitizer, any byte beyond the end is an error
      } catch (const NetworkFileError&) {
      }
    }
}

TEST(FlatTable, EachWildOffsetIsRefused) {
  const Bytes good = file();
  const std::uint32_t root = root_of(good);
  Bytes bytes = good;
  put<std::uint32_t>(bytes, 0, static_cast<std::uint32_t>(good.size()));
  EXPECT_THROW(FlatTable::root(bytes, "TFL3"), NetworkFileError);
  bytes = good;
  put<std::int32_t>(bytes, root, 1 << 20);  // its fields would be before the file
  EXPECT_THROW(FlatTable::root(bytes, "TFL3"), NetworkFileError);
  bytes = good;
  put<std::uint32_t>(bytes, root + 8, 1U << 20);  // the text
  EXPECT_THROW(FlatTable::root(bytes, "TFL3").text(2), NetworkFileError);
}

TEST(FlatTable, ALengthBeyondTheEndIsRefusedWithoutBeingAllocated) {
  Writer w;
  const auto at = w.table({Writer::offset(0)});
  w.fill_table(0);
  w.fill(at[0]);
  w.put<std::uint32_t>(0xfffffff0U);
  const Bytes bytes = w.take();
  const FlatTable root = FlatTable::root(bytes, "TFL3");
  EXPECT_THROW(root.values<double>(0), NetworkFileError);
  EXPECT_THROW(root.tables(0), NetworkFileError);
  EXPECT_THROW(root.text(0), NetworkFileError);
}

}  // namespace
}  // namespace foretrack
