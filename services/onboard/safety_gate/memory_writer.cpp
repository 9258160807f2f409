// SPDX-License-Identifier: Apache-2.0
#include "services/onboard/safety_gate/memory_writer.hpp"

#include <utility>

#include "services/onboard/safety_gate/memory_file.hpp"

namespace foretrack {

MemoryWriter::MemoryWriter(std::filesystem::path file) : file_(std::move(file)) {
  if (file_.empty()) return;
  progress_ = {.written_revision = 0, .failed_revision = 0};
  thread_ = std::thread([this] { run(); });
}

MemoryWriter::~MemoryWriter() {
  {
    const std::lock_guard lock(mutex_);
    ends_ = true;
  }
  changed_.notify_one();
  if (thread_.joinable()) thread_.join();
}

void MemoryWriter::write(const GateMemory& memory) {
  if (file_.empty()) return;
  {
    const std::lock_guard lock(mutex_);
    waits_ = memory;
  }
  changed_.notify_one();
}

MemoryWriting MemoryWriter::progress() const {
  const std::lock_guard lock(mutex_);
  return progress_;
}

void MemoryWriter::run() {
  std::unique_lock lock(mutex_);
  while (true) {
    changed_.wait(lock, [this] { return waits_ || ends_; });
    if (!waits_) return;
    const GateMemory memory = *std::exchange(waits_, std::nullopt);
    lock.unlock();
    const bool written = write_memory(file_, memory);
    lock.lock();
    (written ? progress_.written_revision : progress_.failed_revision) = memory.revision;
  }
}

}  // namespace foretrack
