// SPDX-License-Identifier: Apache-2.0
// One thread, one wait-set: samples and timers call back until the stop.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "services/common/node.hpp"
#include "services/common/reader.hpp"
#include "services/common/ros_server.hpp"
#include "services/common/stop.hpp"

namespace eprosima::fastdds::dds {
class WaitSet;
}

namespace foretrack {

/// Work per wake-up since the last reset.
struct LoopStats {
  std::uint64_t loops = 0;
  double total_ms = 0.0;
  double max_ms = 0.0;
};

/// Readers given here wake the loop; others are taken when a callback asks them. Callbacks run in
/// the order in which they were added. An exception of a callback is reported, and the loop goes
/// on.
class Loop {
 public:
  Loop(Node& node, Stop& stop) : node_(node), stop_(stop) {}

  /// Calls back with the newest good sample, once a wake-up.
  template <class Topic, class Callback>
  void on_newest(Reader<Topic>& reader, Callback callback) {
    add(reader, [&reader, callback]() mutable {
      if (const auto* sample = reader.take_newest()) callback(*sample);
    });
  }
  /// The same, converted: see Reader.
  template <class Topic, class Convert, class Callback>
  void on_newest(Reader<Topic>& reader, Convert convert, Callback callback) {
    add(reader, [&reader, convert, callback]() mutable {
      if (auto value = reader.take_newest_as(convert)) callback(std::move(*value));
    });
  }

  /// Calls back with every good sample, oldest first.
  template <class Topic, class Callback>
  void on_each(Reader<Topic>& reader, Callback callback) {
    add(reader, [&reader, callback]() mutable { reader.take_each(callback); });
  }
  /// The same, converted: see Reader.
  template <class Topic, class Convert, class Callback>
  void on_each(Reader<Topic>& reader, Convert convert, Callback callback) {
    add(reader, [&reader, convert, callback]() mutable { reader.take_each_as(convert, callback); });
  }

  /// Every period by the node's clock: steady, or simulated. A late timer skips, it does not catch
  /// up. Throws std::invalid_argument if the period is not positive.
  void every(double period_s, std::function<void()> callback);
  /// The same by the steady clock, even in simulated time.
  void every_wall(double period_s, std::function<void()> callback);

  /// Answers the requests of a service of ROS 2. It must outlive the loop.
  void serve(RosServer& server) { servers_.push_back(&server); }

  /// Until the stop is requested.
  void run();
  /// Ends run() after the present wake-up, though no stop was requested.
  void leave() { leaves_ = true; }

  LoopStats take_stats();

 private:
  struct Timer {
    double period_s;
    double next_s;  // < 0: not started yet
    bool wall;
    std::function<void()> callback;
  };
  template <class Topic>
  void add(Reader<Topic>& reader, std::function<void()> handler) {
    handlers_.push_back(std::move(handler));
    wakers_.push_back(&reader.core());
  }
  void guarded(const std::function<void()>& callback);
  void wake_up();
  void run_timer(Timer& timer);
  double wait_s() const;
  void let_best_effort_in(eprosima::fastdds::dds::WaitSet& wait_set);

  Node& node_;
  Stop& stop_;
  std::vector<std::function<void()>> handlers_;
  std::vector<ReaderCore*> wakers_;
  std::vector<RosServer*> servers_;
  std::vector<Timer> timers_;
  bool leaves_ = false;
  LoopStats stats_;
};

}  // namespace foretrack
