// SPDX-License-Identifier: Apache-2.0
// How a loop is told to end: by a signal, by another thread, by itself.
#pragma once

#include <memory>

namespace foretrack {

/// Wakes every loop that waits on it, at once. Thread-safe. It stays requested.
class Stop {
 public:
  Stop();
  ~Stop();
  void request();
  bool requested() const;

  struct Dds;
  Dds& dds() { return *dds_; }

 private:
  std::unique_ptr<Dds> dds_;
};

/// While it lives, SIGINT and SIGTERM request the stop; the second one ends the process at once.
/// Make it first in main, before any other thread: it blocks both signals in this thread and its
/// later children, and a thread of its own waits for them, so that no handler runs anywhere.
class SignalStop {
 public:
  explicit SignalStop(Stop& stop);
  ~SignalStop();

 private:
  struct Waiter;
  std::unique_ptr<Waiter> waiter_;
};

}  // namespace foretrack
