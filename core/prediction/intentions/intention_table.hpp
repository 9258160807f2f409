// SPDX-License-Identifier: Apache-2.0
// The intentions that are shipped. To add one: its file in this folder, its place and its row here.
// The build says what is missing; `fit_intention` (bench/prediction) fits its head.
#pragma once

#include <optional>

#include "core/prediction/intentions/decelerate.hpp"
#include "core/prediction/intentions/forward.hpp"
#include "core/prediction/intentions/turn.hpp"

namespace foretrack {

enum class Intention : std::uint8_t { kForward, kTurnLeft, kTurnRight, kDecelerate };

/// The row at this place.
constexpr IntentionRow at_place(Intention id, IntentionRow row) {
  row.id = id;
  return row;
}

inline constexpr std::array kIntentions{
    at_place(Intention::kForward, intentions::kForward),
    at_place(Intention::kTurnLeft, intentions::kTurnLeft),
    at_place(Intention::kTurnRight, intentions::kTurnRight),
    at_place(Intention::kDecelerate, intentions::kDecelerate),
};
inline constexpr int kIntentionCount = static_cast<int>(kIntentions.size());

/// Empty, or what is wrong with the first row that is not as it must be.
constexpr std::string_view fault_of(IntentionTable table) {
  constexpr std::size_t kLongestName = 32;  // of a message
  if (table.empty() || table.size() > kMaxIntentions) return "1 to 16 rows";
  for (std::size_t i = 0; i < table.size(); ++i) {
    const IntentionRow& row = table[i];
    if (index_of(row.id) != static_cast<int>(i)) return "each row at its place";
    if (row.name.empty() || row.name.size() > kLongestName) return "a name of 1 to 32 characters";
    for (std::size_t j = 0; j < i; ++j)
      if (table[j].name == row.name) return "another name for each row";
    if (!row.potential || !row.observation || !row.motion_model) return "R, O and a motion model";
    if (row.noise_m2_s3 <= 0.0) return "noise above 0";
    if (i == 0 && (row.head || row.features)) return "no head at place 0: its logit is 0";
    if (row.head && (!row.features || !row.head->weights))
      return "a head with features and weights";
    if (row.head && row.head->features > FeatureVector::kCapacity)
      return "no more than 64 features";
  }
  return {};
}
static_assert(fault_of(kIntentions).empty());

/// The place of a name; none: nobody of the table has it.
constexpr std::optional<Intention> intention_named(std::string_view name,
                                                   IntentionTable table = kIntentions) {
  for (const IntentionRow& row : table)
    if (row.name == name) return row.id;
  return std::nullopt;
}

constexpr const IntentionRow& row_of(Intention id, IntentionTable table = kIntentions) {
  return table[static_cast<std::size_t>(index_of(id))];
}

}  // namespace foretrack
