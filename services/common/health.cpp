// SPDX-License-Identifier: Apache-2.0
#include "services/common/health.hpp"

#include <fmt/format.h>

namespace foretrack {
namespace {

using namespace foretrack_msgs::msg;
using Clock_ = std::chrono::steady_clock;

constexpr std::size_t kMaxTopics = 64;
constexpr std::size_t kMaxReasons = 16;

double seconds_between(Clock_::time_point from, Clock_::time_point to) {
  return std::chrono::duration<double>(to - from).count();
}

diagnostic_msgs::msg::KeyValue row(const std::string& key, const std::string& value) {
  diagnostic_msgs::msg::KeyValue result;
  result.key(key);
  result.value(value);
  return result;
}

// What was not even read, as if it were a topic: it has reasons and counts as those have.
TopicCount refusals_of(const WireFilter& wire) {
  TopicCount result;
  result.topic(std::string(kWireTopic));
  result.samples(wire.accepted());
  result.age_s(-1.0);
  for (const auto& [reason, messages] : wire.refused_by_reason()) {
    result.rejected().emplace_back();
    result.rejected().back().reason(reason);
    result.rejected().back().samples(messages);
  }
  return result;
}

}  // namespace

Health::Health(Node& node)
    : node_(node), health_(node), diagnostics_(node), started_(Clock_::now()), last_(started_) {}

void Health::set_degraded(const std::string& reason) {
  if (!reason.empty() && reason != degraded_) node_.report(reason);
  degraded_ = reason;
}

void Health::set_fact(const std::string& key, const std::string& value) {
  facts_.push_back(row(key, value));
}

TopicCount Health::count_of(const EndpointStats& stats, double elapsed_s) {
  if (next_ == counted_.size()) counted_.push_back(0);
  auto& before = counted_[next_++];
  TopicCount result;
  result.topic(stats.topic);
  result.writes(stats.writes);
  result.samples(stats.samples);
  result.rate_hz(elapsed_s > 0.0 ? static_cast<double>(stats.samples - before) / elapsed_s : 0.0);
  result.age_s(stats.age_s());
  result.peers(static_cast<std::uint32_t>(stats.peers.load()));
  for (const auto& [reason, samples] : stats.rejected) {
    if (result.rejected().size() == kMaxReasons) break;
    result.rejected().emplace_back();
    result.rejected().back().reason(reason);
    result.rejected().back().samples(samples);
  }
  before = stats.samples;
  return result;
}

void Health::fill(LoopStats loop, bool stopping, double elapsed_s) {
  auto& m = health_.sample();
  m.header().stamp(node_.clock().now());
  m.service(node_.options().service);
  m.state(stopping            ? ServiceHealth_Constants::STATE_STOPPING
          : degraded_.empty() ? ServiceHealth_Constants::STATE_RUNNING
                              : ServiceHealth_Constants::STATE_DEGRADED);
  m.uptime_s(seconds_between(started_, last_));
  m.cpu_percent(cpu_.percent());
  m.rss_bytes(resident_bytes());
  m.loops(loop.loops);
  m.loop_mean_ms(loop.loops > 0 ? loop.total_ms / static_cast<double>(loop.loops) : 0.0);
  m.loop_max_ms(loop.max_ms);
  m.foreign_endpoints(static_cast<std::uint32_t>(node_.foreign_endpoints().size()));
  m.last_error(degraded_.empty() ? node_.last_error() : degraded_);
  m.topics().clear();
  next_ = 0;
  const auto add = [&](const EndpointStats& stats) {
    if (m.topics().size() < kMaxTopics) m.topics().push_back(count_of(stats, elapsed_s));
  };
  for (const auto& writer : node_.writers()) add(writer->stats);
  for (const auto& reader : node_.readers()) add(reader->stats);
  if (const auto& wire = node_.wire(); wire.refused() > 0 && m.topics().size() < kMaxTopics)
    m.topics().push_back(refusals_of(wire));
}

void Health::publish(LoopStats loop, bool stopping) {
  const auto now = Clock_::now();
  const double elapsed = seconds_between(last_, now);
  last_ = now;
  fill(loop, stopping, elapsed);
  health_.write();
  publish_diagnostic();
}

void Health::publish_diagnostic() {
  const auto& h = health_.sample();
  auto& m = diagnostics_.sample();
  m.header().stamp(h.header().stamp());
  m.status().resize(1);
  auto& status = m.status().front();
  const bool degraded = h.state() == ServiceHealth_Constants::STATE_DEGRADED;
  status.level(degraded ? diagnostic_msgs::msg::DiagnosticStatus_Constants::WARN
                        : diagnostic_msgs::msg::DiagnosticStatus_Constants::OK);
  status.name(node_.options().names.vehicle + '/' + node_.options().service);
  status.message(degraded ? degraded_ : "running");
  status.hardware_id(node_.options().names.vehicle);
  status.values() = {row("cpu_percent", fmt::format("{:.1f}", h.cpu_percent())),
                     row("rss_MiB", fmt::format("{:.1f}", h.rss_bytes() / 1048576.0)),
                     row("loop_max_ms", fmt::format("{:.2f}", h.loop_max_ms())),
                     row("last_error", h.last_error().to_string())};
  status.values().insert(status.values().end(), facts_.begin(), facts_.end());
  diagnostics_.write();
}

}  // namespace foretrack
