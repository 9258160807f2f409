// SPDX-License-Identifier: Apache-2.0
// What is made of a recording for whoever asks the server: in a thread of its own, as a recording
// may be long.
#pragma once

#include <filesystem>
#include <functional>
#include <thread>

#include "services/ground_station/http/message.hpp"

namespace foretrack::station {

/// One at a time. Belongs to the server's thread.
class FileMaker {
 public:
  /// `post` runs a function in the server's thread, from any thread.
  using Post = std::function<void(std::function<void()>)>;
  explicit FileMaker(Post post) : post_(std::move(post)) {}
  /// Waits for the one that is being made.
  ~FileMaker();

  /// Answers with what `make` returns for it, or with why there is nothing: 404, 422 (what it
  /// throws), 503 (another one is being made).
  void make(const std::filesystem::path& recording,
            std::function<Response(const std::filesystem::path&)> make, const Respond& respond);

 private:
  Post post_;
  std::thread thread_;
  bool busy_ = false;
};

/// What happened in it, as a page.
Response report_of(const std::filesystem::path& recording);

/// What one vehicle saw, as a video. `query`: vehicle=NAME&from_s=S&to_s=S, each of which may be
/// missing. Throws std::invalid_argument if it is not that, and std::runtime_error as make_clip().
Response clip_of(const std::filesystem::path& recording, const std::string& query);

}  // namespace foretrack::station
