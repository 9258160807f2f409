// SPDX-License-Identifier: Apache-2.0
#include "services/common/dds_log.hpp"

#include <spdlog/spdlog.h>

#include <fastdds/dds/log/Log.hpp>
#include <mutex>
#include <set>
#include <string_view>
#include <utility>

namespace foretrack {
namespace {

namespace dds = eprosima::fastdds::dds;

std::mutex complaint_mutex;
std::string complaint;

// The first one says most: what follows only passes it on.
void keep_complaint(const dds::Log::Entry& entry) {
  const std::string_view category = entry.context.category ? entry.context.category : "";
  if (entry.kind != dds::Log::Kind::Error || category.find("SECURITY") == std::string_view::npos)
    return;
  const std::lock_guard lock(complaint_mutex);
  if (complaint.empty()) complaint = entry.message;
}

std::mutex watches_mutex;
std::set<const RoleWatch::Callback*> watches;

// "Error checking create remote writer 01.0f…|0.0.1.3 (rt/… topic not found in allow rule. (./src…
void tell_watches(const dds::Log::Entry& entry) {
  if (!entry.message.starts_with("Error checking create remote ")) return;
  const auto begin = entry.message.find('(') + 1, end = entry.message.find(" (./", begin);
  const std::lock_guard lock(watches_mutex);
  for (const auto* watch : watches) (*watch)(entry.message.substr(begin, end - begin));
}

struct Consumer : dds::LogConsumer {
  void Consume(const dds::Log::Entry& entry) override {
    keep_complaint(entry);
    tell_watches(entry);
    const auto level =
        entry.kind == dds::Log::Kind::Error ? spdlog::level::warn : spdlog::level::debug;
    spdlog::log(level, "DDS {}: {}", entry.context.category ? entry.context.category : "",
                entry.message);
  }
};

}  // namespace

void log_dds() {
  dds::Log::ClearConsumers();
  dds::Log::RegisterConsumer(std::make_unique<Consumer>());
}

RoleWatch::RoleWatch(Callback callback) : callback_(std::move(callback)) {
  const std::lock_guard lock(watches_mutex);
  watches.insert(&callback_);
}

RoleWatch::~RoleWatch() {
  const std::lock_guard lock(watches_mutex);
  watches.erase(&callback_);
}

std::string security_complaint() {
  dds::Log::Flush();
  const std::lock_guard lock(complaint_mutex);
  return std::exchange(complaint, "");
}

}  // namespace foretrack
