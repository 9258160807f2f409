// SPDX-License-Identifier: Apache-2.0
#include "core/perception/stream_params.hpp"

namespace foretrack {

ParamRows rows(StreamParams& p) {
  return {
      {"enabled", &p.enabled, "", 0, 0, "whether pictures are sent to the ground"},
      {"bandwidth_kbit_s", &p.bandwidth_kbit_s, "kbit/s", 50.0, 50000.0,
       "of the pictures, at the mean of a second"},
      {"width_px", &p.width_px, "px", 64, 4096,
       "wider images are scaled down to it; their height in proportion"},
      {"rate_hz", &p.rate_hz, "Hz", 0.5, 60.0, "no more pictures a second are sent"},
      {"quality_min", &p.quality_min, "1", 5, 95,
       "of JPEG, 1 to 100: where this is too much for the bandwidth, fewer pictures are sent"},
      {"quality_max", &p.quality_max, "1", 5, 95, "it is no better than this, however much fits"},
  };
}

}  // namespace foretrack
