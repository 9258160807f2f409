// SPDX-License-Identifier: Apache-2.0
#include "core/planning/search/search_summary.hpp"

#include <algorithm>
#include <cmath>

#include "core/planning/search/lost_person.hpp"

namespace foretrack {
namespace {

// The cells around all walkers, no more than there is room for about the likeliest place.
void lay_cells(const LostPerson& lost, SearchSummary& out) {
  Vec2 low = lost.likeliest_m, high = lost.likeliest_m;
  const Vec2 most = Vec2::Constant(0.5 * (SearchSummary::kCells - 2) * out.cell_m);
  for (const Walker& w : lost.cloud.walkers) {
    low = low.cwiseMin(w.at_m);
    high = high.cwiseMax(w.at_m);
  }
  low = low.cwiseMax(lost.likeliest_m - most);
  high = high.cwiseMin(lost.likeliest_m + most);
  out.corner_m = out.cell_m * (low / out.cell_m).array().floor();
  const Vec2 span = (high - out.corner_m) / out.cell_m;
  out.columns = std::clamp(static_cast<int>(span.x()) + 1, 1, SearchSummary::kCells);
  out.rows = std::clamp(static_cast<int>(span.y()) + 1, 1, SearchSummary::kCells);
}

void fill_cells(const LostPerson& lost, SearchSummary& out) {
  std::array<float, SearchSummary::kCells * SearchSummary::kCells> sum{};
  float most = 1e-9F;
  for (const Walker& w : lost.cloud.walkers) {
    const Vec2 at = (w.at_m - out.corner_m) / out.cell_m;
    const int x = std::clamp(static_cast<int>(std::floor(at.x())), 0, out.columns - 1);
    const int y = std::clamp(static_cast<int>(std::floor(at.y())), 0, out.rows - 1);
    float& cell = sum[y * out.columns + x];
    cell += static_cast<float>(w.weight);
    most = std::max(most, cell);
  }
  for (int i = 0; i < out.columns * out.rows; ++i)
    out.belief[i] = static_cast<std::uint8_t>(std::lround(255.0F * sum[i] / most));
}

}  // namespace

void summarize(const LostPerson& lost, double now_s, const PlanningParams& params,
               SearchSummary& out) {
  out.stamp_s = now_s;
  out.columns = out.rows = 0;
  out.mode = SearchMode::kNone;
  if (!lost.active) return;
  out.mode = lost.waits ? SearchMode::kWaiting : SearchMode::kSearching;
  out.unseen_s = now_s - lost.since_s;
  out.likeliest_enu_m << lost.likeliest_m, lost.torso_m;
  out.has_viewpoint = lost.viewpoint.worth >= 0.0 && !lost.waits;
  out.viewpoint_enu_m << lost.viewpoint.at_m, lost.torso_m + params.place.height_above_target_m;
  out.gaze_rad = lost.gaze_rad;
  out.speed_max_m_s = search_speed_m_s(lost, params);
  lay_cells(lost, out);
  fill_cells(lost, out);
}

}  // namespace foretrack
