// SPDX-License-Identifier: Apache-2.0
#include "services/ground_station/http/server.hpp"

#include <chrono>
#include <stdexcept>

#include "services/ground_station/http/connection.hpp"
#include "services/ground_station/http/server_impl.hpp"

namespace foretrack::station {
namespace {

constexpr auto kAcceptPause = std::chrono::milliseconds(100);  // after an error: out of files

void load_certificate(Server::Impl& server) {
  const auto& options = server.options;
  if (options.certificate_file.empty()) return;
  server.tls = std::make_unique<asio::ssl::context>(asio::ssl::context::tls_server);
  server.tls->set_options(asio::ssl::context::default_workarounds | asio::ssl::context::no_tlsv1 |
                          asio::ssl::context::no_tlsv1_1);
  server.tls->use_certificate_chain_file(options.certificate_file);
  server.tls->use_private_key_file(options.key_file, asio::ssl::context::pem);
}

void listen(Server::Impl& server) {
  const tcp::endpoint endpoint(asio::ip::make_address(server.options.address), server.options.port);
  server.acceptor.open(endpoint.protocol());
  server.acceptor.set_option(asio::socket_base::reuse_address(true));
  server.acceptor.bind(endpoint);
  server.acceptor.listen(32);
}

void accept(Server::Impl& server);

void accept_later(Server::Impl& server) {
  auto timer = std::make_shared<asio::steady_timer>(server.io, kAcceptPause);
  timer->async_wait([&server, timer](beast::error_code) { accept(server); });
}

void accept(Server::Impl& server) {
  server.acceptor.async_accept([&server](beast::error_code error, tcp::socket socket) {
    if (error == asio::error::operation_aborted) return;
    if (error) return accept_later(server);
    if (server.connections < server.options.connections)
      (server.tls ? start_tls : start_plain)(server, std::move(socket));
    accept(server);
  });
}

void repeat(asio::io_context& io, std::chrono::duration<double> period,
            const std::shared_ptr<std::function<void()>>& work) {
  const auto wait = std::chrono::duration_cast<std::chrono::steady_clock::duration>(period);
  auto timer = std::make_shared<asio::steady_timer>(io, wait);
  timer->async_wait([&io, period, work, timer](beast::error_code error) {
    if (error) return;
    (*work)();
    repeat(io, period, work);
  });
}

}  // namespace

Server::Server(const ServerOptions& options, Hub& hub)
    : impl_(std::make_unique<Impl>(options, hub)) {
  try {
    load_certificate(*impl_);
    listen(*impl_);
  } catch (const std::exception& error) {
    throw std::runtime_error("the station cannot listen on " + options.address + " port " +
                             std::to_string(options.port) + ": " + error.what());
  }
}

Server::~Server() = default;

void Server::set_handler(Handler handler) {
  impl_->handler = std::move(handler);
}
void Server::set_guard(GuardOptions guard) {
  impl_->guard = std::move(guard);
}
void Server::set_admission(std::function<std::string(const Request&)> admission) {
  impl_->admission = std::move(admission);
}

unsigned short Server::port() const {
  return impl_->acceptor.local_endpoint().port();
}

void Server::run() {
  accept(*impl_);
  impl_->io.run();
}

void Server::stop() {
  impl_->io.stop();
}

void Server::post(std::function<void()> work) {
  asio::post(impl_->io, std::move(work));
}

void Server::every(double period_s, std::function<void()> work) {
  repeat(impl_->io, std::chrono::duration<double>(period_s),
         std::make_shared<std::function<void()>>(std::move(work)));
}

void Server::after(double delay_s, std::function<void()> work) {
  const auto wait = std::chrono::duration_cast<std::chrono::steady_clock::duration>(
      std::chrono::duration<double>(delay_s));
  auto timer = std::make_shared<asio::steady_timer>(impl_->io, wait);
  timer->async_wait([timer, work = std::move(work)](beast::error_code error) {
    if (!error) work();
  });
}

}  // namespace foretrack::station
