// SPDX-License-Identifier: Apache-2.0
#include "core/simulator/radio_link.hpp"

#include <algorithm>

namespace foretrack {

bool hears(const LinkParams& link, std::string_view sender, std::string_view receiver,
           double now_s) {
  for (const LinkPartition& partition : link.partitions) {
    if (now_s < partition.from_s || now_s >= partition.to_s) continue;
    const bool together =
        std::any_of(partition.groups.begin(), partition.groups.end(), [&](const auto& group) {
          return std::find(group.begin(), group.end(), sender) != group.end() &&
                 std::find(group.begin(), group.end(), receiver) != group.end();
        });
    if (!together) return false;
  }
  return true;
}

std::optional<double> arrival_s(const LinkParams& link, std::string_view sender,
                                std::string_view receiver, double now_s, Random& random) {
  const bool lost = random.chance(link.loss);
  const double jitter_s = random.uniform(0.0, link.jitter_s);
  if (lost || !hears(link, sender, receiver, now_s)) return std::nullopt;
  return now_s + link.delay_s + jitter_s;
}

}  // namespace foretrack
