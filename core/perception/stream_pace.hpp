// SPDX-License-Identifier: Apache-2.0
// When a picture is sent to the ground, and how good it is, so that a bandwidth is kept.
#pragma once

#include "core/perception/stream_params.hpp"

namespace foretrack {

/// The caller owns it.
struct StreamPace {
  double next_s = -1e9;      ///< before it no picture is due
  double quality = 60.0;     ///< of the next picture
  double allowance_s = 0.0;  ///< when all that was sent has gone through at the bandwidth
};

/// Whether the image of that stamp is to be sent. Then the next one is not due before the rate
/// allows it. A stamp that lies a second or more back begins anew.
bool is_due(StreamPace& pace, double stamp_s, const StreamParams& params);

/// Of JPEG, 1 to 100, for the picture that is encoded next.
int quality_of(const StreamPace& pace, const StreamParams& params);

/// A picture of so many bytes was sent. The next one is better or worse, by which their mean comes
/// to what the bandwidth has for each; where the worst is still too large, the next waits.
void sent(StreamPace& pace, double stamp_s, double bytes, const StreamParams& params);

}  // namespace foretrack
