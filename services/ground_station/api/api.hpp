// SPDX-License-Identifier: Apache-2.0
// The requests under /api/, /recordings/, /reports/ and /clips/, and who may make them.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "services/ground_station/api/file_maker.hpp"
#include "services/ground_station/control/audit.hpp"
#include "services/ground_station/control/commander.hpp"
#include "services/ground_station/control/tokens.hpp"
#include "services/ground_station/http/message.hpp"
#include "services/ground_station/recording/recorder.hpp"

namespace foretrack::station {

struct ApiOptions {
  bool enable_control = false;
  bool token_to_read = false;  // to see anything at all; to order anything, always
  std::filesystem::path recordings;
};

/// Belongs to the server's thread. Without a commander nothing can be ordered.
class Api {
 public:
  Api(const ApiOptions& options, const Tokens& tokens, Audit& audit, Commander* commander,
      Recorder& recorder, std::function<std::string()> status, FileMaker::Post post);

  /// Whether the path is of the API; then it answers, now or when a vehicle has.
  bool handle(const Request& request, const Respond& respond, double now_s);
  /// Empty: the request may see what is shown. Else why not.
  std::string refusal_to_read(const Request& request) const;

  /// Called when a recording began or ended.
  std::function<void()> on_recording;

 private:
  struct Order;
  void get(const Request& request, const Respond& respond);
  void post(const Request& request, const Respond& respond, double now_s);
  void lease(const Order& order, double now_s);
  void command(const Order& order, double now_s);
  void record(const Order& order);
  bool may_ask(double now_s);

  ApiOptions options_;
  const Tokens& tokens_;
  Audit& audit_;
  Commander* commander_;
  Recorder& recorder_;
  std::function<std::string()> status_;
  FileMaker files_;
  double allowance_ = 0.0;  // requests
  double asked_s_ = 0.0;
};

}  // namespace foretrack::station
