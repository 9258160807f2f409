// SPDX-License-Identifier: Apache-2.0
#include "services/convert/search.hpp"

#include <algorithm>

#include "services/convert/geometry.hpp"

namespace foretrack {
namespace {

namespace modes = foretrack_msgs::msg::TargetSearch_Constants;
static_assert(modes::MODE_NONE == int(SearchMode::kNone));
static_assert(modes::MODE_SEARCHING == int(SearchMode::kSearching));
static_assert(modes::MODE_WAITING == int(SearchMode::kWaiting));

constexpr double kMostCell_m = 100.0;
constexpr double kMostUnseen_s = 1e6;

}  // namespace

void to_idl(const SearchSummary& in, foretrack_msgs::msg::TargetSearch& out) {
  set_header(out.header(), in.stamp_s);
  out.mode(static_cast<std::uint8_t>(in.mode));
  out.unseen_s(in.unseen_s);
  out.likeliest_m(to_array(in.likeliest_enu_m));
  out.has_viewpoint(in.has_viewpoint);
  out.viewpoint_m(to_array(in.viewpoint_enu_m));
  out.gaze_yaw_rad(in.gaze_rad);
  out.speed_max_mps(in.speed_max_m_s);
  out.corner_m({in.corner_m.x(), in.corner_m.y()});
  out.cell_m(in.cell_m);
  out.columns(static_cast<std::uint8_t>(in.columns));
  out.rows(static_cast<std::uint8_t>(in.rows));
  out.belief().assign(in.belief.begin(), in.belief.begin() + in.columns * in.rows);
}

Converted<SearchSummary> from_idl(const foretrack_msgs::msg::TargetSearch& in) {
  Checks checks;
  SearchSummary out;
  check_header(checks, in.header());
  checks.enumerator("search.mode", in.mode(), modes::MODE_WAITING);
  checks.in_range("search.unseen_s", in.unseen_s(), 0.0, kMostUnseen_s);
  checks.within("search.likeliest_m", in.likeliest_m(), limits::kPosition_m);
  checks.within("search.viewpoint_m", in.viewpoint_m(), limits::kPosition_m);
  checks.within("search.gaze_yaw_rad", in.gaze_yaw_rad(), 2.0 * kPi);
  checks.in_range("search.speed_max_mps", in.speed_max_mps(), 0.0, limits::kSpeed_m_s);
  for (const double v : in.corner_m()) checks.within("search.corner_m", v, limits::kPosition_m);
  checks.positive("search.cell_m", in.cell_m(), kMostCell_m);
  checks.in_range("search.columns", in.columns(), 0, SearchSummary::kCells);
  checks.in_range("search.rows", in.rows(), 0, SearchSummary::kCells);
  const auto cells = static_cast<std::size_t>(in.columns()) * in.rows();
  checks.count("search.belief", in.belief().size(), cells, cells);
  if (!checks.ok()) return checks.result(out);
  out.stamp_s = seconds(in.header().stamp());
  out.mode = static_cast<SearchMode>(in.mode());
  out.unseen_s = in.unseen_s();
  out.likeliest_enu_m = to_vec3(in.likeliest_m());
  out.has_viewpoint = in.has_viewpoint();
  out.viewpoint_enu_m = to_vec3(in.viewpoint_m());
  out.gaze_rad = in.gaze_yaw_rad();
  out.speed_max_m_s = in.speed_max_mps();
  out.corner_m = {in.corner_m()[0], in.corner_m()[1]};
  out.cell_m = in.cell_m();
  out.columns = in.columns();
  out.rows = in.rows();
  std::ranges::copy(in.belief(), out.belief.begin());
  return checks.result(out);
}

}  // namespace foretrack
