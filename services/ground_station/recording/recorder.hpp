// SPDX-License-Identifier: Apache-2.0
// Records every channel to MCAP files, in a thread of its own.
#pragma once

#include <condition_variable>
#include <deque>
#include <filesystem>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "services/ground_station/bus/channel.hpp"
#include "services/ground_station/status.hpp"

namespace foretrack::station {

struct RecorderOptions {
  std::filesystem::path folder = "recordings";
  std::vector<std::string> topics;  // only those that contain one of these; empty: all
  std::function<bool(const Channel&)> leave_out;  // none: nothing is left out
  std::uint64_t split_bytes = 1ull << 30;
  std::size_t queue_bytes = 32u << 20;  // what a slow disk may leave waiting; more is lost
  std::map<std::string, std::map<std::string, std::string>> metadata;  // by name
};

/// open(), close() and samples() never wait for the disk. Each chunk is on disk at most a second
/// after its first sample. A full disk ends the recording; what was written stays readable.
class Recorder {
 public:
  explicit Recorder(RecorderOptions options);
  ~Recorder();

  // A source's outlet. From one thread.
  void open(const Channel& channel);
  void samples(const std::vector<Sample>& samples);

  // From any thread.
  /// Why it cannot; empty: it records.
  std::string start();
  void end();   // returns at once; status() is none when all is written
  void stop();  // waits for that
  /// None: it does not record.
  std::optional<RecordingStatus> status() const;
  /// Why the last recording ended by itself; empty: it did not.
  std::string fault() const;
  /// Of those that are open, the channels that it wants.
  std::set<std::uint32_t> wanted() const;

 private:
  struct File;
  void write_all();
  void write(const std::vector<Sample>& samples);
  bool next_file();
  std::filesystem::path file_name() const;
  bool wants(const Channel& channel) const;

  RecorderOptions options_;
  std::thread thread_;
  std::unique_ptr<File> file_;  // the thread's
  std::string stem_;
  int part_ = 0;

  mutable std::mutex mutex_;  // guards what follows
  std::condition_variable news_;
  std::map<std::uint32_t, Channel> channels_;
  std::map<std::uint32_t, Sample> latched_;  // the last of each
  std::deque<std::vector<Sample>> queue_;
  std::size_t queued_bytes_ = 0;
  bool recording_ = false;
  bool stopping_ = false;
  double started_s_ = 0.0;
  RecordingStatus status_;
  std::string fault_;
};

/// Metadata that a recording shall have: versions, host, and the parameters' text if there is one.
std::map<std::string, std::map<std::string, std::string>> recording_metadata(
    const std::string& parameters);

}  // namespace foretrack::station
