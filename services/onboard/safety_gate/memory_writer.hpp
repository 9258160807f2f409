// SPDX-License-Identifier: Apache-2.0
// Writes the gate's memory outside of its loop, since a disk may take long.
#pragma once

#include <condition_variable>
#include <filesystem>
#include <mutex>
#include <optional>
#include <thread>

#include "core/safety/take_order.hpp"

namespace foretrack {

class MemoryWriter {
 public:
  /// Without a file nothing is written, and nothing waits to be.
  explicit MemoryWriter(std::filesystem::path file);
  /// Writes what waits.
  ~MemoryWriter();
  MemoryWriter(const MemoryWriter&) = delete;
  MemoryWriter& operator=(const MemoryWriter&) = delete;

  /// Soon; the newest takes the place of one that waits. Never blocks for the disk.
  void write(const GateMemory& memory);
  MemoryWriting progress() const;

 private:
  void run();

  std::filesystem::path file_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::optional<GateMemory> waits_;
  MemoryWriting progress_;
  bool ends_ = false;
  std::thread thread_;
};

}  // namespace foretrack
