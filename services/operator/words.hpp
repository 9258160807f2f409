// SPDX-License-Identifier: Apache-2.0
// What the numbers in messages mean, for people.
#pragma once

#include <cstdint>
#include <string_view>

namespace foretrack {

std::string_view track_word(std::uint8_t status);       // "tracking"
std::string_view prediction_word(std::uint8_t status);  // "ok"
std::string_view plan_word(std::uint8_t status);        // "fresh"
std::string_view mode_word(std::uint8_t mode);          // "track"
std::string_view service_word(std::uint8_t state);      // "running"

/// Sentences: why there is no new plan; why the gate does not fly it.
std::string_view explain_plan(std::uint8_t reason);
std::string_view explain_gate(std::uint8_t reason);

}  // namespace foretrack
