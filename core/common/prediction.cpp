// SPDX-License-Identifier: Apache-2.0
#include "core/common/prediction.hpp"

#include <algorithm>

namespace foretrack {

PathPoint PredictedPath::at(double time_s) const {
  const auto after = std::ranges::lower_bound(states, time_s, {}, &PredictedState::time_s);
  const PredictedState& near = after == states.end() ? states.back() : *after;
  if (after == states.begin() || after == states.end())
    return {near.position_enu_m + (time_s - near.time_s) * near.velocity_enu_m_s,
            near.velocity_enu_m_s};
  const PredictedState& before = *(after - 1);
  const double part = (time_s - before.time_s) / (near.time_s - before.time_s);
  return {before.position_enu_m + part * (near.position_enu_m - before.position_enu_m),
          before.velocity_enu_m_s + part * (near.velocity_enu_m_s - before.velocity_enu_m_s)};
}

}  // namespace foretrack
