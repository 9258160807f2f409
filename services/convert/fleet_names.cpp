// SPDX-License-Identifier: Apache-2.0
#include "services/convert/fleet_names.hpp"

namespace foretrack {

void check_vehicle(Checks& checks, std::string_view name) {
  constexpr std::size_t kMost = 32;
  checks.count("vehicle", name.size(), 1, kMost);
}

void check_seat(Checks& checks, int seat) {
  checks.in_range("seat", seat, -1, kSeatCount - 1);
}

void write_intentions(const std::array<double, kMaxIntentions>& probabilities, int count,
                      FleetIntentions& out) {
  out.resize(count == 0 ? 0 : kIntentions.size());
  for (std::size_t i = 0; i < out.size(); ++i) {
    const IntentionRow& row = kIntentions[i];
    out[i].name(std::string(row.name));
    out[i].probability(static_cast<float>(probabilities[index_of(row.id)]));
  }
}

FleetPlaces read_intentions(Checks& checks, const FleetIntentions& in,
                            std::array<double, kMaxIntentions>& probabilities, int& known) {
  FleetPlaces out;
  checks.count("intentions", in.size(), 0, kMaxIntentions);
  if (!checks.ok()) return out;
  double sum = 0.0;
  std::uint32_t seen = 0;  // a bit a place
  for (const auto& row : in) {
    checks.in_range("intentions.probability", row.probability(), 0.0, 1.0);
    sum += row.probability();
    const auto id = intention_named(std::string_view(row.name().c_str()));
    out.places[out.count++] = id ? index_of(*id) : -1;
    if (!id) continue;
    const std::uint32_t bit = 1U << index_of(*id);
    if (seen & bit) checks.fail("intentions.name", row.name().c_str(), "each only once");
    seen |= bit;
    probabilities[index_of(*id)] = row.probability();
  }
  checks.in_range("intentions.probability", sum, 0.0, 1.0 + limits::kSumTolerance);
  known = in.empty() ? 0 : kIntentionCount;
  return out;
}

}  // namespace foretrack
