// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <fstream>

#include "services/onboard/safety_gate/memory_file.hpp"
#include "services/onboard/safety_gate/memory_writer.hpp"
#include "tests/services/common/bus.hpp"
#include "tests/support/folder.hpp"

namespace foretrack {
namespace {

using testing::Folder;

GateMemory stopped(std::uint64_t revision) {
  GateMemory memory;
  memory.revision = revision;
  memory.phase = MissionPhase::kStopped;
  memory.lease_operator = "ada";
  return memory;
}

TEST(MemoryFile, IsReadAsItWasWritten) {
  const Folder folder;
  const auto file = folder.path / "new" / "gate";
  EXPECT_FALSE(read_memory(file));
  ASSERT_TRUE(write_memory(file, stopped(3)));
  ASSERT_TRUE(write_memory(file, stopped(4)));
  const auto memory = read_memory(file);
  ASSERT_TRUE(memory);
  EXPECT_EQ(memory->revision, 4u);
  EXPECT_EQ(memory->phase, MissionPhase::kStopped);
  EXPECT_EQ(memory->lease_operator.view(), "ada");
}

TEST(MemoryFile, IsNoneIfTornRottenOrOfAnotherVersion) {
  const Folder folder;
  const auto file = folder.path / "gate";
  ASSERT_TRUE(write_memory(file, stopped(3)));
  const auto size = std::filesystem::file_size(file);
  for (const auto at : {std::uintmax_t{0}, size / 2, size - 1}) {
    ASSERT_TRUE(write_memory(file, stopped(3)));
    std::fstream rot(file, std::ios::binary | std::ios::in | std::ios::out);
    rot.seekp(static_cast<std::streamoff>(at));
    rot.put('\x55');
    rot.close();
    EXPECT_FALSE(read_memory(file)) << at;
  }
  ASSERT_TRUE(write_memory(file, stopped(3)));
  std::filesystem::resize_file(file, size - 1);
  EXPECT_FALSE(read_memory(file));
  GateMemory other = stopped(3);
  other.version = GateMemory::kVersion + 1;
  ASSERT_TRUE(write_memory(file, other));
  EXPECT_FALSE(read_memory(file));
}

TEST(MemoryWriter, SaysWhatTheDiskTook) {
  const Folder folder;
  MemoryWriter writer(folder.path / "gate");
  EXPECT_EQ(writer.progress().written_revision, 0u);
  writer.write(stopped(7));
  EXPECT_TRUE(testing::eventually([&] { return writer.progress().written_revision == 7; }));
  EXPECT_EQ(read_memory(folder.path / "gate")->revision, 7u);
}

TEST(MemoryWriter, SaysWhatAFullDiskDidNotTake) {
  MemoryWriter writer("/dev/full/gate");  // no folder can be there
  writer.write(stopped(7));
  EXPECT_TRUE(testing::eventually([&] { return writer.progress().failed_revision == 7; }));
  EXPECT_EQ(writer.progress().written_revision, 0u);
}

TEST(MemoryWriter, WritesWhatWaitsBeforeItEnds) {
  const Folder folder;
  {
    MemoryWriter writer(folder.path / "gate");
    writer.write(stopped(1));
    writer.write(stopped(2));
  }
  EXPECT_EQ(read_memory(folder.path / "gate")->revision, 2u);
}

TEST(MemoryWriter, WaitsForNothingWithoutAFile) {
  MemoryWriter writer("");
  writer.write(stopped(7));
  EXPECT_GE(writer.progress().written_revision, 7u);
}

}  // namespace
}  // namespace foretrack
