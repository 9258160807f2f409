// SPDX-License-Identifier: Apache-2.0
#include "services/ground_station/http/connection.hpp"

#include <netinet/tcp.h>

#include <memory>
#include <string>

#include "services/ground_station/http/requests.hpp"
#include "services/ground_station/http/server_impl.hpp"
#include "services/ground_station/http/websocket.hpp"

namespace foretrack::station {
namespace {

// For small messages that must not wait and for data that must not pile up in the kernel. Returns
// the other end's address.
std::string tune(tcp::socket& socket) {
  beast::error_code error;
  socket.set_option(tcp::no_delay(true), error);
  const int unsent_bytes = 16 * 1024;  // more would be old before a slow link takes it
  setsockopt(socket.native_handle(), IPPROTO_TCP, TCP_NOTSENT_LOWAT, &unsent_bytes,
             sizeof unsent_bytes);
  // Goes on where a radio link loses packets, which others take for congestion; not every kernel
  // has it.
  setsockopt(socket.native_handle(), IPPROTO_TCP, TCP_CONGESTION, "bbr", 3);
  const auto end = socket.remote_endpoint(error);
  return error ? "?" : end.address().to_string() + ':' + std::to_string(end.port());
}

template <class Stream>
class Connection : public std::enable_shared_from_this<Connection<Stream>> {
 public:
  Connection(Server::Impl& server, Stream stream, std::string remote)
      : server_(server), stream_(std::move(stream)), remote_(std::move(remote)) {
    ++server_.connections;
  }
  ~Connection() { --server_.connections; }

  void read() {
    parser_.emplace();
    parser_->header_limit(static_cast<std::uint32_t>(server_.options.header_bytes));
    parser_->body_limit(server_.options.body_bytes);
    limit_time();
    http::async_read(stream_, buffer_, *parser_,
                     [self = this->shared_from_this()](beast::error_code error, std::size_t) {
                       self->on_read(error);
                     });
  }

  /// The limit covers a whole request, so that a client that sends byte by byte is cut off.
  void limit_time() {
    beast::get_lowest_layer(stream_).expires_after(
        std::chrono::duration_cast<std::chrono::steady_clock::duration>(
            std::chrono::duration<double>(server_.options.request_limit_s)));
  }

 protected:
  Stream& stream() { return stream_; }

 private:
  void on_read(beast::error_code error) {
    if (error == http::error::end_of_stream) return close();
    if (error == http::error::header_limit || error == http::error::body_limit)
      return send(text_response(413, "the request is too large"), false);
    if (error == beast::error::timeout) return;
    if (error.category() == http::make_error_code(http::error::bad_method).category() && error)
      return send(text_response(400, "not a request: " + error.message()), false);
    if (error) return close();
    request_ = to_request(parser_->get(), remote_);
    if (auto refused = refuse(server_.guard, request_)) return send(std::move(*refused), false);
    if (websocket::is_upgrade(parser_->get())) return upgrade();
    const bool keep_alive = parser_->get().keep_alive();
    beast::get_lowest_layer(stream_).expires_never();  // the handler may take its time
    server_.handler(request_, [self = this->shared_from_this(), keep_alive](Response response) {
      self->limit_time();
      self->send(std::move(response), keep_alive);
    });
  }

  void upgrade() {
    if (request_.path != "/ws") return send(text_response(404, "WebSockets are at /ws"), false);
    if (server_.clients >= server_.options.clients)
      return send(text_response(503, "too many clients"), false);
    const std::string asked(parser_->get()[http::field::sec_websocket_protocol]);
    if (foxglove::choose_subprotocol(asked).empty())
      return send(text_response(400, "subprotocol foxglove.websocket.v1 expected"), false);
    if (const auto why = server_.admission(request_); !why.empty())
      return send(text_response(401, why), false);
    beast::get_lowest_layer(stream_).expires_never();
    std::make_shared<WebSocket<Stream>>(server_, std::move(stream_), remote_)
        ->accept(parser_->release());
  }

  void send(Response response, bool keep_alive) {
    limit_time();
    auto body = std::move(response.file);
    head_ = to_head(response, body, parser_->get().version(), keep_alive, request_,
                    server_.tls != nullptr);
    if (!body || request_.method == "HEAD") return send_all(keep_alive);
    file_.emplace(*body);
    if (!file_->good()) return close();
    serializer_.emplace(*head_);
    http::async_write_header(
        stream_, *serializer_,
        [self = this->shared_from_this(), keep_alive](beast::error_code error, std::size_t) {
          error ? self->close() : self->send_file(keep_alive);
        });
  }

  void send_all(bool keep_alive) {
    http::async_write(
        stream_, *head_,
        [self = this->shared_from_this(), keep_alive](beast::error_code error, std::size_t) {
          error || !keep_alive ? self->close() : self->read();
        });
  }

  void send_file(bool keep_alive) {
    const auto piece = file_->next();
    if (piece.empty()) return file_->complete() && keep_alive ? read() : close();
    limit_time();
    asio::async_write(
        stream_, asio::buffer(piece.data(), piece.size()),
        [self = this->shared_from_this(), keep_alive](beast::error_code error, std::size_t) {
          error ? self->close() : self->send_file(keep_alive);
        });
  }

  void close() {
    beast::error_code ignored;
    beast::get_lowest_layer(stream_).socket().shutdown(tcp::socket::shutdown_send, ignored);
  }

  Server::Impl& server_;
  Stream stream_;
  std::string remote_;
  beast::flat_buffer buffer_{64 * 1024 + 16 * 1024};
  std::optional<http::request_parser<http::string_body>> parser_;
  Request request_;
  std::optional<http::response<http::string_body>> head_;
  std::optional<http::response_serializer<http::string_body>> serializer_;
  std::optional<FileReader> file_;
};

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

void start_plain(Server::Impl& server, tcp::socket socket) {
  const auto remote = tune(socket);
  auto connection = std::make_shared<Connection<beast::tcp_stream>>(
      server, beast::tcp_stream(std::move(socket)), remote);
  connection->read();
}

void start_tls(Server::Impl& server, tcp::socket socket) {
  const auto remote = tune(socket);
  std::make_shared<TlsConnection>(
      server, TlsStream(beast::tcp_stream(std::move(socket)), *server.tls), remote)
      ->shake_hands();
}

}  // namespace foretrack::station
