// SPDX-License-Identifier: Apache-2.0
// Parameters of the choice of whom to follow.
#pragma once

#include "core/common/params.hpp"

namespace foretrack {

/// Differences are those of lasting_difference() (core/common/appearance.hpp): about 0.2 for one
/// person from any two sides, 0.3 and more for others. Ranges are in the rows: see rows(), or
/// `foretrack params choice`.
struct ChoiceParams {
  /// who is followed first where several are seen: 0 whom the detector is most certain of, 1 the
  /// nearest, 2 who is in the middle of the image; 3 nobody but who wears the colour below
  int start = 0;
  int start_red = 128;    ///< of the upper body's clothes in the image, with start 3: red
  int start_green = 128;  ///< the same: green
  int start_blue = 128;   ///< the same: blue
  double wait_s = 15.0;   ///< who is asked which of two it is has so long to answer
  int unanswered = 0;     ///< then: 0 on with the likeliest, 1 hold
  double alike = 0.3;     ///< clothes that differ more are somebody else's
  /// of two people, clothes whose differences from what is remembered are nearer are alike
  double tell_apart = 0.2;
  double meet_m = 1.0;  ///< people this near, or in line as seen from the vehicle, may be mixed up
  double settle_s = 0.7;     ///< after they have parted, they are compared for so long
  int doubtful_looks = 3;    ///< images that leave a doubt who is who, for it to count
  double learn_s = 20.0;     ///< time in which what is remembered of the clothes follows them
  double search_s = 60.0;    ///< who is not found for so long is lost
  double candidate_s = 1.0;  ///< somebody must be seen so long to be compared
};
/// One row for each field: name, unit, range, meaning.
ParamRows rows(ChoiceParams& params);

}  // namespace foretrack
