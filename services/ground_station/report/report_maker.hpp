// SPDX-License-Identifier: Apache-2.0
// Reports for whoever asks the server: made in a thread of their own, as a recording may be long.
#pragma once

#include <filesystem>
#include <functional>
#include <thread>

#include "services/ground_station/http/message.hpp"

namespace foretrack::station {

/// One at a time. Belongs to the server's thread.
class ReportMaker {
 public:
  /// `post` runs a function in the server's thread, from any thread.
  using Post = std::function<void(std::function<void()>)>;
  explicit ReportMaker(Post post) : post_(std::move(post)) {}
  /// Waits for the one that is being made.
  ~ReportMaker();

  /// Answers with the page, or with why there is none: 404, 422 (it holds nothing), 503 (another
  /// one is being made).
  void make(const std::filesystem::path& recording, const Respond& respond);

 private:
  Post post_;
  std::thread thread_;
  bool busy_ = false;
};

}  // namespace foretrack::station
