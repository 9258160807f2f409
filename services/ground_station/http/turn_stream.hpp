// SPDX-License-Identifier: Apache-2.0
// A stream that two may write to, one after the other: what WebSockets say of themselves (pings,
// farewells) and the station's own frames, several in one system call.
#pragma once

#include <memory>
#include <utility>

#include "services/ground_station/http/beast.hpp"

namespace foretrack::station {

/// Each write is whole before the next begins. At most one of each kind is under way, so at most
/// one waits. For one thread.
template <class Next>
class TurnStream {
 public:
  using next_layer_type = Next;
  using executor_type = beast::executor_type<Next>;

  explicit TurnStream(Next&& next) : next_(std::move(next)) {}

  executor_type get_executor() { return next_.get_executor(); }
  Next& next_layer() { return next_; }
  const Next& next_layer() const { return next_; }

  template <class Buffers, class Handler>
  auto async_read_some(const Buffers& buffers, Handler&& handler) {
    return next_.async_read_some(buffers, std::forward<Handler>(handler));
  }

  /// Writes all, not some.
  template <class Buffers, class Handler>
  auto async_write_some(const Buffers& buffers, Handler&& handler) {
    return asio::async_initiate<Handler, void(beast::error_code, std::size_t)>(
        [this](auto final_handler, const auto& to_write) {
          wait_for_turn([this, to_write, then = std::move(final_handler)]() mutable {
            asio::async_write(next_, to_write, Turn<decltype(then)>{*this, std::move(then)});
          });
        },
        handler, buffers);
  }

 private:
  struct Waiting {
    virtual ~Waiting() = default;
    virtual void begin() = 0;
  };
  template <class Work>
  struct WaitingWork final : Waiting {
    explicit WaitingWork(Work&& its_work) : work(std::move(its_work)) {}
    void begin() override { work(); }
    Work work;
  };
  template <class Handler>
  struct Turn {
    TurnStream& stream;
    Handler then;
    void operator()(beast::error_code error, std::size_t bytes) {
      stream.end_turn();
      then(error, bytes);
    }
  };

  template <class Work>
  void wait_for_turn(Work work) {
    if (busy_) {
      waiting_ = std::make_unique<WaitingWork<Work>>(std::move(work));
    } else {
      busy_ = true;
      work();
    }
  }
  void end_turn() {
    busy_ = waiting_ != nullptr;
    if (const auto next = std::move(waiting_)) next->begin();
  }

  Next next_;
  std::unique_ptr<Waiting> waiting_;
  bool busy_ = false;
};

template <class Next>
void teardown(beast::role_type role, TurnStream<Next>& stream, beast::error_code& error) {
  using websocket::teardown;
  teardown(role, stream.next_layer(), error);
}

template <class Next, class Handler>
void async_teardown(beast::role_type role, TurnStream<Next>& stream, Handler&& handler) {
  using websocket::async_teardown;
  async_teardown(role, stream.next_layer(), std::forward<Handler>(handler));
}

}  // namespace foretrack::station
