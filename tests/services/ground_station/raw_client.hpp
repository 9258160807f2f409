// SPDX-License-Identifier: Apache-2.0
// A TCP client that sends any bytes: what an attacker has.
#pragma once

#include <arpa/inet.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <chrono>
#include <string>

namespace foretrack::testing {

class RawClient {
 public:
  explicit RawClient(unsigned short port) : fd_(socket(AF_INET, SOCK_STREAM, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(port);
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    connected_ = connect(fd_, reinterpret_cast<sockaddr*>(&address), sizeof address) == 0;
  }
  ~RawClient() { close(fd_); }
  RawClient(const RawClient&) = delete;
  RawClient& operator=(const RawClient&) = delete;

  bool connected() const { return connected_; }
  bool send(const std::string& bytes) {
    return ::send(fd_, bytes.data(), bytes.size(), MSG_NOSIGNAL) ==
           static_cast<ssize_t>(bytes.size());
  }
  /// What comes until it holds the text, the other side closes, or the limit is over.
  std::string read_until(const std::string& text, double limit_s = 5.0) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(limit_s);
    while (got_.find(text) == std::string::npos && std::chrono::steady_clock::now() < end) {
      pollfd poll_fd{fd_, POLLIN, 0};
      if (poll(&poll_fd, 1, 50) <= 0) continue;
      char buffer[65536];
      const auto n = recv(fd_, buffer, sizeof buffer, 0);
      if (n <= 0) {
        closed_ = true;
        break;
      }
      got_.append(buffer, static_cast<std::size_t>(n));
    }
    return got_;
  }
  /// Whether the other side closes within the limit.
  bool is_closed(double limit_s = 5.0) {
    read_until("\x01never\x01", limit_s);
    return closed_;
  }

 private:
  int fd_;
  bool connected_ = false, closed_ = false;
  std::string got_;
};

/// A request as a program sends it; `extra` are header lines, each with its end.
inline std::string request(const std::string& head, unsigned short port,
                           const std::string& extra = {}, const std::string& body = {}) {
  return head + " HTTP/1.1\r\nHost: 127.0.0.1:" + std::to_string(port) + "\r\n" + extra +
         (body.empty() ? "" : "Content-Length: " + std::to_string(body.size()) + "\r\n") + "\r\n" +
         body;
}

inline std::string upgrade(unsigned short port, const std::string& path = "/ws",
                           const std::string& extra = {}) {
  return request("GET " + path, port,
                 "Connection: Upgrade\r\nUpgrade: websocket\r\nSec-WebSocket-Version: 13\r\n"
                 "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n"
                 "Sec-WebSocket-Protocol: foxglove.websocket.v1\r\n" +
                     extra);
}

/// A client's WebSocket frame, masked with zeros.
inline std::string frame(unsigned char first_byte, const std::string& payload) {
  std::string bytes(1, static_cast<char>(first_byte));
  const auto size = payload.size();
  if (size < 126) {
    bytes += static_cast<char>(0x80 | size);
  } else {  // in as few bytes as it can be, or it is refused
    const bool is_short = size < 65536;
    bytes += static_cast<char>(0x80 | (is_short ? 126 : 127));
    for (int i = is_short ? 1 : 7; i >= 0; --i) bytes += static_cast<char>(size >> (8 * i));
  }
  return bytes + std::string(4, '\0') + payload;
}

}  // namespace foretrack::testing
