// SPDX-License-Identifier: Apache-2.0
// What DDS logs, as lines of ours; and what it complained of last.
#pragma once

#include <string>

namespace foretrack {

/// From now on its log goes where ours goes: errors as warnings, the rest for debugging.
void log_dds();

/// Why DDS-Security refused, as far as it told, in one line; empty: it said nothing. Since the last
/// call.
std::string security_complaint();

}  // namespace foretrack
