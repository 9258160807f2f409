// SPDX-License-Identifier: Apache-2.0
// What a writer or reader knows of itself, and the untyped half of both.
#pragma once

#include <array>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "services/common/names.hpp"
#include "services/common/type_ops.hpp"

namespace foretrack {

class Node;

/// Written by the service's thread, but for the atomics, which middleware threads write.
struct EndpointStats {
  using Time = std::chrono::steady_clock::time_point;

  std::string topic;
  const char* profile = "";
  bool writes = false;
  std::uint64_t samples = 0;                                    // written, or accepted
  Time last{};                                                  // of the last sample
  std::vector<std::pair<std::string, std::uint64_t>> rejected;  // by reason
  std::uint64_t of_second_writers = 0;                          // accepted all the same
  std::atomic<int> peers = 0;
  std::atomic<std::uint64_t> incompatible_qos = 0;
  std::atomic<std::uint64_t> lost = 0;

  void accept();
  void reject(std::string_view reason);
  std::uint64_t rejected_for(std::string_view reason) const;
  double age_s() const;  // since the last sample; −1: none yet
};

/// The untyped halves. They live in the node, which takes them down in order.
class WriterCore {
 public:
  struct Dds;
  WriterCore(Node& node, const TopicInfo& info, const TypeOps& ops);
  ~WriterCore();
  bool write(const void* sample);

  EndpointStats stats;
  std::unique_ptr<Dds> dds;
};

/// Of a topic that drivers write (TopicInfo::any_writer) a reader is reliable, as lost pieces of
/// big images are asked for again, until a best-effort writer offers it less: from then on it is
/// best effort itself, and hears both kinds.
class ReaderCore {
 public:
  struct Dds;
  ReaderCore(Node& node, const TopicInfo& info, const TypeOps& ops);
  ~ReaderCore();
  /// False: nothing is left. Malformed samples are counted and skipped.
  bool take(void* sample);
  /// From now on only one writer is heard, the first. Samples of another one are refused, as those
  /// of a second writer, until the first has been silent for so long (or is gone): a process that
  /// was started again takes its place.
  void pin_writer(double silence_s) { pin_silence_s_ = silence_s; }
  /// The same, but samples of a second writer are taken, and counted (`of_second_writers`).
  void notice_second_writers(double silence_s) {
    pin_silence_s_ = silence_s;
    refuses_others_ = false;
  }
  /// Whether a best-effort writer waits to be heard. Then hear_best_effort() makes another reader:
  /// whoever waits for the old one must let go of it first.
  bool wants_best_effort() const;
  void hear_best_effort();

  EndpointStats stats;
  std::unique_ptr<Dds> dds;
  bool waited_for = false;  // by a loop, which then changes the reader

 private:
  void make_reader(bool best_effort);
  using WriterId = std::array<std::uint8_t, 16>;
  bool is_of_the_pinned_writer(const WriterId& from);

  Node& node_;
  TopicInfo info_;
  TypeOps ops_;
  double pin_silence_s_ = -1.0;  // < 0: any writer is heard
  bool refuses_others_ = true;
  WriterId pinned_{};
  EndpointStats::Time pinned_heard_{};
};

/// The reason under which the samples of a second writer are counted.
inline constexpr std::string_view kSecondWriter = "a second writer";

}  // namespace foretrack
