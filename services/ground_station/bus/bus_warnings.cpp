// SPDX-License-Identifier: Apache-2.0
#include "services/ground_station/bus/bus_warnings.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstring>
#include <set>

namespace foretrack::station {
namespace {

constexpr double kClockLimit_s = 0.3;
constexpr std::size_t kEncapsulation = 4;
constexpr std::int32_t kNoWallClock_s = 100'000'000;  // stamps before 1973 are simulated time

}  // namespace

std::optional<double> clock_ahead_s(const Bytes& sample, std::int64_t came_ns) {
  std::int32_t sec = 0;
  std::uint32_t nanosec = 0;
  if (sample.size() < kEncapsulation + 8 || sample[1] != 1) return std::nullopt;
  std::memcpy(&sec, sample.data() + kEncapsulation, 4);
  std::memcpy(&nanosec, sample.data() + kEncapsulation + 4, 4);
  if (sec < kNoWallClock_s) return std::nullopt;
  return 1e-9 * static_cast<double>(sec * 1'000'000'000ll + nanosec - came_ns);
}

std::vector<std::string> warnings_of(const Node& node,
                                     const std::map<std::string, double>& clocks_ahead_s) {
  std::vector<std::string> result;
  if (const char* unsecured = node.why_unsecured(); *unsecured) result.emplace_back(unsecured);
  for (const auto& [reason, messages] : node.wire().refused_by_reason())
    result.push_back(fmt::format("{} × refused on the network: {}", messages, reason));
  std::set<std::string> versions;
  for (const auto& endpoint : node.endpoints())
    if (!endpoint.other_version.empty())
      versions.insert(
          fmt::format("{}: {}; it is misread", endpoint.topic.substr(2), endpoint.other_version));
  result.insert(result.end(), versions.begin(), versions.end());
  for (const auto& [vehicle, ahead_s] : clocks_ahead_s)
    if (std::abs(ahead_s) > kClockLimit_s)
      result.push_back(
          fmt::format("the clock of {} is {:+.1f} s off this machine's", vehicle, ahead_s));
  return result;
}

}  // namespace foretrack::station
