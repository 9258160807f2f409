// SPDX-License-Identifier: Apache-2.0
// Who is followed, how sure that is, and who else it might be.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/choice/choose.hpp"
#include "foretrack_msgs/msg/TargetChoice.h"
#include "services/convert/checks.hpp"

namespace foretrack {

/// A choice as the world may know it, with pictures (JPEG; empty: none).
struct ChoiceReport {
  double stamp_s = 0.0;
  ChoiceResult choice;
  std::vector<std::uint8_t> picture = {};  // of who was chosen
  std::array<std::vector<std::uint8_t>, ChoiceResult::kMostCandidates> pictures = {};
};
/// A picture that is larger than the IDL allows is left out.
void to_idl(const ChoiceReport& report, foretrack_msgs::msg::TargetChoice& out);
/// Without the pictures, which are for people.
Converted<ChoiceReport> from_idl(const foretrack_msgs::msg::TargetChoice& in);

}  // namespace foretrack
