// SPDX-License-Identifier: Apache-2.0
// Names in messages of a fleet: of vehicles, of seats, and of intentions, of which receivers may
// know more or fewer.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "core/fleet/fleet_member.hpp"
#include "core/prediction/intentions/intention_table.hpp"
#include "foretrack_msgs/msg/FleetMember.h"
#include "services/convert/checks.hpp"

namespace foretrack {

/// Not empty, at most 32 long.
void check_vehicle(Checks& checks, std::string_view name);
/// −1: none.
void check_seat(Checks& checks, int seat);

using FleetIntentions = std::vector<foretrack_msgs::msg::FleetIntention>;

/// Names with probabilities, none if `count` is 0.
void write_intentions(const std::array<double, kMaxIntentions>& probabilities, int count,
                      FleetIntentions& out);

/// Where the intentions of a message are in our table.
struct FleetPlaces {
  int count = 0;                             ///< that are told
  std::array<int, kMaxIntentions> places{};  ///< of each; −1: it is not known here
};
/// Each only once, probabilities from 0 to 1 and no more than 1 in sum. `known`: how many of ours
/// have a probability then: all or none.
FleetPlaces read_intentions(Checks& checks, const FleetIntentions& in,
                            std::array<double, kMaxIntentions>& probabilities, int& known);

}  // namespace foretrack
