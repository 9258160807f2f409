// SPDX-License-Identifier: Apache-2.0
// What the server shares with its connections.
#pragma once

#include "services/ground_station/http/beast.hpp"
#include "services/ground_station/http/server.hpp"

namespace foretrack::station {

struct Server::Impl {
  Impl(const ServerOptions& server_options, Hub& its_hub)
      : options(server_options), hub(its_hub), acceptor(io) {}

  ServerOptions options;
  Hub& hub;
  GuardOptions guard;
  Handler handler;
  std::function<std::string(const Request&)> admission;
  asio::io_context io{1};
  tcp::acceptor acceptor;
  std::unique_ptr<asio::ssl::context> tls;
  std::size_t connections = 0;
  std::size_t clients = 0;
};

}  // namespace foretrack::station
