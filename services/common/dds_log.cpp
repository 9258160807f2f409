// SPDX-License-Identifier: Apache-2.0
#include "services/common/dds_log.hpp"

#include <spdlog/spdlog.h>

#include <fastdds/dds/log/Log.hpp>
#include <mutex>
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

struct Consumer : dds::LogConsumer {
  void Consume(const dds::Log::Entry& entry) override {
    keep_complaint(entry);
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

std::string security_complaint() {
  dds::Log::Flush();
  const std::lock_guard lock(complaint_mutex);
  return std::exchange(complaint, "");
}

}  // namespace foretrack
