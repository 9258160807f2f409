// SPDX-License-Identifier: Apache-2.0
// What planning tells of a search.
#pragma once

#include "core/planning/search/search_summary.hpp"
#include "foretrack_msgs/msg/TargetSearch.h"
#include "services/convert/checks.hpp"

namespace foretrack {

void to_idl(const SearchSummary& search, foretrack_msgs::msg::TargetSearch& out);
/// The belief must be as large as it says.
Converted<SearchSummary> from_idl(const foretrack_msgs::msg::TargetSearch& in);

}  // namespace foretrack
