// SPDX-License-Identifier: Apache-2.0
#include "services/ground_station/http/connection.hpp"

namespace foretrack::station {

void start_plain(Server::Impl& server, tcp::socket socket) {
  const auto remote = tune(socket);
  auto connection = std::make_shared<Connection<beast::tcp_stream>>(
      server, beast::tcp_stream(std::move(socket)), remote);
  connection->read();
}

}  // namespace foretrack::station
