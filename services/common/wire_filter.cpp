// SPDX-License-Identifier: Apache-2.0
#include "services/common/wire_filter.hpp"

#include <fmt/format.h>

#include "services/common/time_now.hpp"

namespace foretrack {
namespace {

constexpr double kReportPeriod_s = 10.0;

// A blanked parameter's id becomes that of padding. The buffer that was received may be others' as
// well (shared memory), so this is done in a copy.
std::span<const std::uint8_t> blanked(std::span<const std::uint8_t> message,
                                      const wire::Checked& checked) {
  thread_local std::vector<std::uint8_t> copy;
  copy.assign(message.begin(), message.end());
  for (std::size_t i = 0; i < checked.blank_count; ++i)
    copy[checked.blanks[i]] = copy[checked.blanks[i] + 1] = 0;
  return copy;
}

}  // namespace

WireFilter::Verdict WireFilter::judge(std::span<const std::uint8_t> message) {
  const wire::Checked checked = wire::check_message(message);
  if (checked.fault != wire::Fault::kNone) return {checked.fault, {}};
  if (demands_identity_ && checked.of_stranger) return {wire::Fault::kStranger, {}};
  ++accepted_;
  const auto kept = message.first(checked.size);
  return {wire::Fault::kNone, checked.blank_count == 0 ? kept : blanked(kept, checked)};
}

void WireFilter::refuse(wire::Fault fault, const std::string& from) {
  ++refused_[static_cast<std::size_t>(fault)];
  const std::lock_guard lock(report_mutex_);
  const double now_s = steady_s();
  if (now_s < next_report_s_) return;
  next_report_s_ = now_s + kReportPeriod_s;
  report_(fmt::format("refused of {}: {}; {} so far", from, wire::word(fault), refused()));
}

std::uint64_t WireFilter::refused() const {
  std::uint64_t sum = 0;
  for (const auto& count : refused_) sum += count;
  return sum;
}

WireFilter::Counts WireFilter::refused_by_reason() const {
  Counts result;
  for (std::size_t i = 0; i < refused_.size(); ++i)
    if (refused_[i] > 0) result.emplace_back(wire::word(static_cast<wire::Fault>(i)), refused_[i]);
  return result;
}

}  // namespace foretrack
