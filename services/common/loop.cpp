// SPDX-License-Identifier: Apache-2.0
#include "services/common/loop.hpp"

#include <algorithm>
#include <chrono>
#include <exception>
#include <fastdds/dds/core/condition/WaitSet.hpp>
#include <stdexcept>

#include "services/common/dds_impl.hpp"
#include "services/common/time_now.hpp"

namespace foretrack {
namespace {

constexpr double kLongestWait_s = 1.0;
constexpr double kRetry_s = 0.01;  // where a client's reader is not there yet

void add_timer_check(double period_s) {
  if (!(period_s > 0.0))
    throw std::invalid_argument("timer period " + std::to_string(period_s) + " s: > 0 expected");
}

}  // namespace

void Loop::every(double period_s, std::function<void()> callback) {
  add_timer_check(period_s);
  timers_.push_back({period_s, -1.0, false, std::move(callback)});
}

void Loop::every_wall(double period_s, std::function<void()> callback) {
  add_timer_check(period_s);
  timers_.push_back({period_s, -1.0, true, std::move(callback)});
}

void Loop::guarded(const std::function<void()>& callback) try {
  callback();
} catch (const std::exception& error) {
  node_.report(std::string("a callback failed: ") + error.what());
}

void Loop::run_timer(Timer& timer) {
  const double now = timer.wall ? steady_s() : node_.clock().steady_s();
  const bool jumped_back = timer.next_s > now + 2.0 * timer.period_s;
  if (timer.next_s < 0.0 || jumped_back) timer.next_s = now;
  if (now < timer.next_s) return;
  timer.next_s += timer.period_s;
  if (timer.next_s <= now) timer.next_s = now + timer.period_s;
  guarded(timer.callback);
}

// Simulated timers are woken by clock samples, so only the others bound the wait.
double Loop::wait_s() const {
  double wait = kLongestWait_s;
  const double now = steady_s();
  for (const auto& timer : timers_)
    if (timer.wall || !node_.clock().simulated()) wait = std::min(wait, timer.next_s - now);
  for (const auto* server : servers_)
    if (server->waits()) wait = std::min(wait, kRetry_s);
  return std::max(wait, 0.0);
}

void Loop::wake_up() {
  const double start = steady_s();
  node_.clock().update();
  for (const auto& handler : handlers_) guarded(handler);
  for (auto* server : servers_) guarded([server] { server->update(); });
  for (auto& timer : timers_) run_timer(timer);
  const double ms = 1e3 * (steady_s() - start);
  ++stats_.loops;
  stats_.total_ms += ms;
  stats_.max_ms = std::max(stats_.max_ms, ms);
}

void Loop::let_best_effort_in(dds::WaitSet& wait_set) {
  for (auto* reader : wakers_) {
    if (!reader->wants_best_effort()) continue;
    wait_set.detach_condition(reader->dds->reader->get_statuscondition());
    reader->hear_best_effort();
    wait_set.attach_condition(reader->dds->reader->get_statuscondition());
  }
}

void Loop::run() {
  dds::WaitSet wait_set;
  wait_set.attach_condition(stop_.dds().condition);
  if (auto* clock = node_.clock().reader()) wakers_.push_back(clock);
  for (auto* server : servers_) wait_set.attach_condition(server->requests().condition());
  for (auto* reader : wakers_) {
    reader->waited_for = true;
    wait_set.attach_condition(reader->dds->reader->get_statuscondition());
  }
  while (!stop_.requested() && !leaves_) {
    let_best_effort_in(wait_set);
    wake_up();
    if (leaves_) break;
    dds::ConditionSeq active;
    const double wait = wait_s();
    const auto whole = static_cast<std::int32_t>(wait);
    wait_set.wait(active, {whole, static_cast<std::uint32_t>(1e9 * (wait - whole))});
  }
  for (auto* reader : wakers_) {
    wait_set.detach_condition(reader->dds->reader->get_statuscondition());
    reader->waited_for = false;
  }
  for (auto* server : servers_) wait_set.detach_condition(server->requests().condition());
  wait_set.detach_condition(stop_.dds().condition);
}

LoopStats Loop::take_stats() {
  return std::exchange(stats_, LoopStats{});
}

}  // namespace foretrack
