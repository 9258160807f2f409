// SPDX-License-Identifier: Apache-2.0
// How well the followed person is told from others by what they wear: staged meetings and returns
// of rendered people.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "core/choice/choose.hpp"

namespace foretrack {

/// What happens to the two.
enum class IdentityEvent : std::uint8_t {
  kMeeting,     ///< they meet, and part; half of the time the track goes on with the other one
  kReturn,      ///< the person leaves, and comes back minutes later
  kStranger,    ///< the person leaves, and somebody else comes
  kBothReturn,  ///< both come
};
inline constexpr std::array<std::string_view, 4> kIdentityEventNames = {"meeting", "return",
                                                                        "stranger", "both"};

/// What came of the events of one kind.
struct IdentityCell {
  IdentityEvent kind = IdentityEvent::kMeeting;
  bool same = false;  ///< both are the same model, in the same clothes: to ask is right
  int events = 0;
  int wrong = 0;   ///< the other one was followed at the end, unasked
  int asked = 0;   ///< the operator was asked
  int missed = 0;  ///< the person was there, and nobody was followed, and nobody asked
};

struct IdentityRequest {
  int events = 516;
  std::uint64_t seed = 45001;
  ChoiceParams params;
  std::function<bool(int done)> goes_on = {};  ///< false: no more events
};

/// Each event: one of four rendered models is looked at for some seconds, turning, from 2 to 6 m,
/// in any direction to the sun; then what its kind says happens, in another exposure. What is worn
/// is measured in the images at the joints, with the noise of the pose network, five times a
/// second; places are the truth, so that clothes alone decide. In every third event both are the
/// same model (none of those with a stranger alone: nobody could know). Throws std::runtime_error
/// where the models are not installed. Cost: about 0.6 s an event.
std::vector<IdentityCell> bench_identity(const IdentityRequest& request);

/// A table, with the rates of wrong persons and of needless questions.
std::string table_of(const std::vector<IdentityCell>& cells);

}  // namespace foretrack
