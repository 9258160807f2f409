// SPDX-License-Identifier: Apache-2.0
// The parameters of the picture for the ground.
#pragma once

#include "core/common/params.hpp"

namespace foretrack {

/// Ranges are in the rows: see rows(), or `foretrack params ground_stream`.
struct StreamParams {
  bool enabled = true;               ///< whether pictures are sent to the ground
  double bandwidth_kbit_s = 2000.0;  ///< of the pictures, at the mean of a second
  int width_px = 640;     ///< wider images are scaled down to it; their height in proportion
  double rate_hz = 15.0;  ///< no more pictures a second are sent
  /// of JPEG, 1 to 100: where this is too much for the bandwidth, fewer pictures are sent
  int quality_min = 25;
  int quality_max = 80;  ///< it is no better than this, however much fits
};

/// One row for each field: name, unit, range, meaning.
ParamRows rows(StreamParams& p);

}  // namespace foretrack
