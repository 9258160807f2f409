// SPDX-License-Identifier: Apache-2.0
#include "services/ground_station/http/connection.hpp"

namespace foretrack::station {
namespace {

using TlsStream = beast::ssl_stream<beast::tcp_stream>;

class TlsConnection : public Connection<TlsStream> {
 public:
  using Connection::Connection;
  void shake_hands() {
    limit_time();
    stream().async_handshake(asio::ssl::stream_base::server,
                             [self = std::static_pointer_cast<TlsConnection>(shared_from_this())](
                                 beast::error_code error) {
                               if (!error) self->read();
                             });
  }
};

}  // namespace

void start_tls(Server::Impl& server, tcp::socket socket) {
  const auto remote = tune(socket);
  std::make_shared<TlsConnection>(
      server, TlsStream(beast::tcp_stream(std::move(socket)), *server.tls), remote)
      ->shake_hands();
}

}  // namespace foretrack::station
