// SPDX-License-Identifier: Apache-2.0
// The web server: one port for pages, requests and WebSockets.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>

#include "services/ground_station/http/guard.hpp"
#include "services/ground_station/http/message.hpp"
#include "services/ground_station/hub/hub.hpp"

namespace foretrack::station {

struct ServerOptions {
  std::string address = "127.0.0.1";
  unsigned short port = 8080;    // 0: a free one
  std::string certificate_file;  // PEM; empty: no TLS
  std::string key_file;
  std::size_t connections = 128;
  std::size_t clients = 64;       // WebSockets among them
  double request_limit_s = 10.0;  // to send a whole request
  std::size_t header_bytes = 8 * 1024;
  std::size_t body_bytes = 64 * 1024;
  std::size_t message_bytes = 64 * 1024;  // from a WebSocket client
};

/// Answers requests, joins WebSocket clients of /ws to the hub. Everything, the hub and the handler
/// too, runs in the thread that calls run().
class Server {
 public:
  /// Throws std::runtime_error if the address cannot be used or the certificate not be read.
  Server(const ServerOptions& options, Hub& hub);
  ~Server();

  /// Before run(). Requests get here after Host and Origin were checked.
  void set_handler(Handler handler);
  void set_guard(GuardOptions guard);
  /// Empty: the WebSocket may be opened. Else why not.
  void set_admission(std::function<std::string(const Request&)> admission);

  unsigned short port() const;
  void run();
  /// From any thread.
  void stop();
  void post(std::function<void()> work);
  /// In run()'s thread, every so many seconds.
  void every(double period_s, std::function<void()> work);
  /// In run()'s thread, once.
  void after(double delay_s, std::function<void()> work);

  struct Impl;

 private:
  std::unique_ptr<Impl> impl_;
};

}  // namespace foretrack::station
