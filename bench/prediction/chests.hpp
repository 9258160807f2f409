// SPDX-License-Identifier: Apache-2.0
// People whose chest points elsewhere than that of those whom prediction was fitted on.
#pragma once

#include <string_view>

#include "bench/prediction/episodes.hpp"

namespace foretrack::bench {

struct NamedChest {
  std::string_view name;
  Chest chest;
};

/// The same that `foretrack bench chests` flies with.
inline constexpr NamedChest kChests[] = {
    {"as fitted", {}},
    {"backwards", {.offset_rad = kPi}},
    {"flips, 30 %", {.flip_share = 0.3}},
    {"69° aside", {.offset_rad = rad(69.0)}},
    {"follows by 0.2 s", {.lead_s = -0.2}},
    {"sways ±40°", {.sway_rad = rad(40.0)}},
    {"23° aside", {.offset_rad = rad(23.0)}},
};

}  // namespace foretrack::bench
