// SPDX-License-Identifier: Apache-2.0
// A WebSocket client of the hub.
#pragma once

#include <memory>
#include <string>

#include "services/ground_station/http/frame_batch.hpp"
#include "services/ground_station/http/server_impl.hpp"
#include "services/ground_station/http/turn_stream.hpp"

namespace foretrack::station {

template <class Stream>
class WebSocket : public std::enable_shared_from_this<WebSocket<Stream>> {
 public:
  WebSocket(Server::Impl& server, Stream stream, std::string remote)
      : server_(server),
        socket_(TurnStream<Stream>(std::move(stream))),
        remote_(std::move(remote)) {
    ++server_.clients;
    ++server_.connections;
  }
  ~WebSocket() {
    --server_.clients;
    --server_.connections;
  }

  void accept(http::request<http::string_body> request) {
    request_ = std::move(request);
    const std::string protocol(
        foxglove::choose_subprotocol(request_[http::field::sec_websocket_protocol].to_string()));
    auto limits = websocket::stream_base::timeout::suggested(beast::role_type::server);
    limits.handshake_timeout = std::chrono::seconds(3);  // and for the other's farewell
    limits.idle_timeout = std::chrono::seconds(20);
    limits.keep_alive_pings = true;
    socket_.set_option(limits);
    socket_.set_option(websocket::stream_base::decorator([protocol](websocket::response_type& r) {
      r.set(http::field::sec_websocket_protocol, protocol);
    }));
    socket_.read_message_max(server_.options.message_bytes);
    socket_.auto_fragment(false);
    socket_.async_accept(request_, [self = this->shared_from_this()](beast::error_code error) {
      if (!error) self->join();
    });
  }

 private:
  void join() {
    const std::weak_ptr<WebSocket> weak = this->shared_from_this();
    Link link;
    link.wake = [weak] {
      if (const auto self = weak.lock()) self->write();
    };
    link.close = [weak](const std::string& reason) {
      if (const auto self = weak.lock()) self->close(reason);
    };
    client_ = server_.hub.join(remote_, std::move(link), steady_s());
    write();
    read();
  }

  void read() {
    socket_.async_read(buffer_,
                       [self = this->shared_from_this()](beast::error_code error, std::size_t) {
                         if (error) return self->leave();
                         if (!self->client_) return;
                         self->on_message();
                         self->read();
                       });
  }

  void on_message() {
    const auto data = buffer_.cdata();
    if (socket_.got_text())
      client_->on_text({static_cast<const char*>(data.data()), data.size()}, steady_s());
    else
      client_->on_binary({static_cast<const std::uint8_t*>(data.data()), data.size()}, steady_s());
    buffer_.consume(buffer_.size());
  }

  // All that waits, in one call; what comes meanwhile waits in the client's outbox.
  void write() {
    if (writing_ || closing_ || !client_ || !socket_.is_open()) return;
    batch_.clear();
    while (!batch_.full()) {
      auto frame = client_->next(steady_s());
      if (!frame) break;
      batch_.add(std::move(*frame));
    }
    if (batch_.empty()) return;
    writing_ = true;
    socket_.next_layer().async_write_some(
        batch_.buffers(), [self = this->shared_from_this()](beast::error_code error, std::size_t) {
          self->writing_ = false;
          if (error) return self->leave();
          if (self->closing_) return self->say_goodbye();
          self->write();
        });
  }

  // A client that takes nothing cannot be told why, so it is given a moment, then cut off.
  void close(const std::string& reason) {
    if (closing_) return;
    closing_ = true;
    reason_ = reason.substr(0, 120);
    if (!writing_)
      return asio::post(socket_.get_executor(),
                        [self = this->shared_from_this()] { self->say_goodbye(); });
    auto timer =
        std::make_shared<asio::steady_timer>(socket_.get_executor(), std::chrono::seconds(2));
    timer->async_wait([weak = std::weak_ptr(this->shared_from_this()), timer](beast::error_code) {
      if (const auto self = weak.lock()) self->cut();
    });
  }

  void say_goodbye() {
    socket_.async_close({websocket::close_code::policy_error, reason_.c_str()},
                        [self = this->shared_from_this()](beast::error_code) { self->leave(); });
  }

  void cut() {
    beast::get_lowest_layer(socket_).close();
    leave();
  }

  void leave() {
    if (client_) server_.hub.leave(*client_);
    client_.reset();
  }

  Server::Impl& server_;
  websocket::stream<TurnStream<Stream>> socket_;
  std::string remote_;
  http::request<http::string_body> request_;
  beast::flat_buffer buffer_;
  std::shared_ptr<Client> client_;
  FrameBatch batch_;
  std::string reason_;
  bool writing_ = false;
  bool closing_ = false;
};

}  // namespace foretrack::station
