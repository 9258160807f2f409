// SPDX-License-Identifier: Apache-2.0
// One TCP connection: requests, until one of them makes it a WebSocket.
#pragma once

#include "services/ground_station/http/beast.hpp"
#include "services/ground_station/http/server.hpp"

namespace foretrack::station {

/// Begin a connection's life, plain or encrypted; it counts itself out when it ends.
void start_plain(Server::Impl& server, tcp::socket socket);
void start_tls(Server::Impl& server, tcp::socket socket);

}  // namespace foretrack::station
