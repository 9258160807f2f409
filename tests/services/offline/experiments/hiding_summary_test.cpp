// SPDX-License-Identifier: Apache-2.0
#include "services/offline/experiments/hiding_summary.hpp"

#include <gtest/gtest.h>

namespace foretrack {
namespace {

FlightJob job_of(std::string experiment) {
  FlightJob job;
  job.cell = {std::move(experiment), "intention", MapSource::kKnown, 0.0};
  job.event = EventKind::kHiding;
  job.command = "again";
  return job;
}

RunRecord record_of(double hidden_s, double until_found_s, double gap_m) {
  RunRecord record;
  record.hidings = {{1.0, 1.0 + hidden_s, 1.0 + hidden_s + until_found_s, gap_m}};
  return record;
}

TEST(HidingSummary, CountsByKindAndByHowLongTheyHid) {
  const std::vector<FlightJob> jobs = {job_of("search/wall"), job_of("search/wall"),
                                       job_of("search/rooms")};
  const std::vector<RunRecord> records = {
      record_of(6.0, 3.0, 1.0), record_of(7.0, 9.0, -0.1),
      record_of(3.0, std::numeric_limits<double>::infinity(), 0.5)};
  const auto cells = summarize_hidings(jobs, records);
  ASSERT_EQ(cells.size(), 4u);
  const HidingCell* wall = nullptr;
  for (const HidingCell& c : cells)
    if (c.name == "wall") wall = &c;
  ASSERT_NE(wall, nullptr);
  EXPECT_EQ(wall->hidings, 2);
  EXPECT_EQ(wall->found, 1);
  EXPECT_EQ(wall->contacts, 1);
  EXPECT_EQ(wall->least_gap_m, -0.1);
  EXPECT_EQ(wall->hidden_from_s, 5.0);
  EXPECT_EQ(wall->until_found_p50_s, 3.0);
  EXPECT_EQ(cells.back().name, "all");
  EXPECT_NE(hidings_json_of(cells).find("\"until_found_p50_s\": null"), std::string::npos);
  const std::string csv = hidings_csv_of(jobs, records);
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 4);
}

}  // namespace
}  // namespace foretrack
