// SPDX-License-Identifier: Apache-2.0
#include "services/common/rosout.hpp"

#include <spdlog/sinks/base_sink.h>

#include <deque>
#include <map>
#include <mutex>
#include <string>
#include <utility>

namespace foretrack {
namespace {

using rcl_interfaces::msg::Log;
namespace log_level = rcl_interfaces::msg::Log_Constants;

constexpr std::size_t kMostLines = 50;  // the profile's depth

std::uint8_t level_of(spdlog::level::level_enum level) {
  switch (level) {
    case spdlog::level::trace:
    case spdlog::level::debug:
      return log_level::DEBUG;
    case spdlog::level::warn:
      return log_level::WARN;
    case spdlog::level::err:
      return log_level::ERROR;
    case spdlog::level::critical:
      return log_level::FATAL;
    default:
      return log_level::INFO;
  }
}

builtin_interfaces::msg::Time stamp_of(spdlog::log_clock::time_point time) {
  const auto ns = std::chrono::nanoseconds(time.time_since_epoch()).count();
  builtin_interfaces::msg::Time stamp;
  stamp.sec(static_cast<std::int32_t>(ns / 1'000'000'000));
  stamp.nanosec(static_cast<std::uint32_t>(ns % 1'000'000'000));
  return stamp;
}

class Sink : public spdlog::sinks::base_sink<std::mutex> {
 public:
  void open(const std::string& service) {
    const std::lock_guard lock(mutex_);
    lines_[service];
  }
  void close(const std::string& service) {
    const std::lock_guard lock(mutex_);
    lines_.erase(service);
  }
  std::deque<Log> take(const std::string& service) {
    const std::lock_guard lock(mutex_);
    const auto it = lines_.find(service);
    return it == lines_.end() ? std::deque<Log>() : std::exchange(it->second, {});
  }

 protected:
  void sink_it_(const spdlog::details::log_msg& message) override {
    const std::string text(message.payload.data(), message.payload.size());
    const auto colon = text.find(": ");
    if (colon == std::string::npos) return;
    const auto it = lines_.find(text.substr(0, colon));
    if (it == lines_.end()) return;
    if (it->second.size() == kMostLines) it->second.pop_front();
    auto& line = it->second.emplace_back();
    line.stamp(stamp_of(message.time));
    line.level(level_of(message.level));
    line.msg(text.substr(colon + 2));
  }
  void flush_() override {}

 private:
  std::map<std::string, std::deque<Log>> lines_;
};

const std::shared_ptr<Sink>& the_sink() {
  static const auto kSink = std::make_shared<Sink>();
  return kSink;
}

}  // namespace

std::shared_ptr<spdlog::sinks::sink> rosout_sink() {
  return the_sink();
}

Rosout::Rosout(Node& node) : node_(node), writer_(node) {
  the_sink()->open(node.options().service);
}

Rosout::~Rosout() {
  the_sink()->close(node_.options().service);
}

void Rosout::publish() {
  const auto& options = node_.options();
  for (auto& line : the_sink()->take(options.service)) {
    if (options.use_sim_time) line.stamp(node_.clock().now());
    line.name(options.names.vehicle + '.' + options.service);
    writer_.write(line);
  }
}

}  // namespace foretrack
