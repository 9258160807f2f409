// SPDX-License-Identifier: Apache-2.0
#include "services/convert/search.hpp"

#include "convert_test_support.hpp"

namespace foretrack {
namespace {

using testing::kNaN;
using SearchMsg = foretrack_msgs::msg::TargetSearch;

SearchSummary summary() {
  SearchSummary s;
  s.mode = SearchMode::kSearching;
  s.stamp_s = 7.25;
  s.unseen_s = 3.5;
  s.likeliest_enu_m = {1, 2, 1.2};
  s.has_viewpoint = true;
  s.viewpoint_enu_m = {4, 5, 1.3};
  s.gaze_rad = -1.0;
  s.speed_max_m_s = 1.5;
  s.corner_m = {-2, 3};
  s.columns = 3;
  s.rows = 2;
  for (int i = 0; i < 6; ++i) s.belief[i] = static_cast<std::uint8_t>(40 * i);
  return s;
}

SearchMsg message() {
  SearchMsg msg;
  to_idl(summary(), msg);
  return msg;
}

TEST(TargetSearchMessage, RoundTrips) {
  const auto out = from_idl(message());
  ASSERT_TRUE(out) << out.fault().text;
  const SearchSummary in = summary();
  EXPECT_EQ(out->mode, in.mode);
  EXPECT_EQ(out->unseen_s, in.unseen_s);
  EXPECT_EQ(out->likeliest_enu_m, in.likeliest_enu_m);
  EXPECT_EQ(out->viewpoint_enu_m, in.viewpoint_enu_m);
  EXPECT_EQ(out->has_viewpoint, in.has_viewpoint);
  EXPECT_EQ(out->gaze_rad, in.gaze_rad);
  EXPECT_EQ(out->speed_max_m_s, in.speed_max_m_s);
  EXPECT_EQ(out->corner_m, in.corner_m);
  EXPECT_EQ(out->columns, in.columns);
  EXPECT_EQ(out->rows, in.rows);
  EXPECT_EQ(out->belief, in.belief);
}

template <class Break>
void expect_refused(Break break_it, std::string_view field) {
  SearchMsg msg = message();
  break_it(msg);
  const auto out = from_idl(msg);
  ASSERT_FALSE(out) << field;
  EXPECT_EQ(out.fault().field, field);
}

TEST(TargetSearchMessage, RefusesWhatCannotBe) {
  expect_refused([](SearchMsg& m) { m.mode(3); }, "search.mode");
  expect_refused([](SearchMsg& m) { m.unseen_s(-1.0); }, "search.unseen_s");
  expect_refused([](SearchMsg& m) { m.likeliest_m()[0] = kNaN; }, "search.likeliest_m");
  expect_refused([](SearchMsg& m) { m.viewpoint_m()[1] = 1e9; }, "search.viewpoint_m");
  expect_refused([](SearchMsg& m) { m.gaze_yaw_rad(kNaN); }, "search.gaze_yaw_rad");
  expect_refused([](SearchMsg& m) { m.speed_max_mps(-0.1); }, "search.speed_max_mps");
  expect_refused([](SearchMsg& m) { m.corner_m()[0] = kNaN; }, "search.corner_m");
  expect_refused([](SearchMsg& m) { m.cell_m(0.0); }, "search.cell_m");
  expect_refused([](SearchMsg& m) { m.columns(49); }, "search.columns");
  expect_refused([](SearchMsg& m) { m.rows(49); }, "search.rows");
  expect_refused([](SearchMsg& m) { m.belief().pop_back(); }, "search.belief");
}

}  // namespace
}  // namespace foretrack
