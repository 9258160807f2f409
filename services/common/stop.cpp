// SPDX-License-Identifier: Apache-2.0
#include "services/common/stop.hpp"

#include <pthread.h>
#include <signal.h>
#include <unistd.h>

#include <atomic>
#include <thread>

#include "services/common/dds_impl.hpp"

namespace foretrack {

Stop::Stop() : dds_(std::make_unique<Dds>()) {}
Stop::~Stop() = default;

void Stop::request() {
  dds_->condition.set_trigger_value(true);
}

bool Stop::requested() const {
  return dds_->condition.get_trigger_value();
}

struct SignalStop::Waiter {
  sigset_t signals{};
  sigset_t before{};
  std::atomic<bool> end = false;
  std::thread thread;
};

namespace {

// SIGUSR2 is only there to end the wait.
void wait_for_signals(const sigset_t& signals, const std::atomic<bool>& end, Stop& stop) {
  bool again = false;
  while (true) {
    int signal = 0;
    sigwait(&signals, &signal);
    if (end) return;
    if (signal == SIGUSR2) continue;
    if (again) _exit(128 + signal);
    again = true;
    stop.request();
  }
}

}  // namespace

SignalStop::SignalStop(Stop& stop) : waiter_(std::make_unique<Waiter>()) {
  auto& w = *waiter_;
  sigemptyset(&w.signals);
  for (const int signal : {SIGINT, SIGTERM, SIGUSR2}) sigaddset(&w.signals, signal);
  pthread_sigmask(SIG_BLOCK, &w.signals, &w.before);
  w.thread = std::thread([&w, &stop] { wait_for_signals(w.signals, w.end, stop); });
}

SignalStop::~SignalStop() {
  waiter_->end = true;
  pthread_kill(waiter_->thread.native_handle(), SIGUSR2);
  waiter_->thread.join();
  pthread_sigmask(SIG_SETMASK, &waiter_->before, nullptr);
}

}  // namespace foretrack
