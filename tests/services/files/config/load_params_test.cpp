// SPDX-License-Identifier: Apache-2.0
#include "services/files/config/load_params.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "tests/support/error_of.hpp"

namespace foretrack {
namespace {

using testing::AllOf;
using testing::HasSubstr;

TrackerParams load(const std::string& text) {
  const auto file = std::filesystem::temp_directory_path() / "foretrack_load_params.yaml";
  std::ofstream(file) << text;
  return load_params(file.string());
}
std::string error_of(const std::string& text) {
  return foretrack::error_of([&] { load(text); });
}

TEST(LoadParams, KeepsTheDefaultsThatTheFileDoesNotName) {
  const TrackerParams params = load("safety:\n  plan_fresh_s: 0.5\nplanning:\nprediction: {}\n");
  EXPECT_EQ(params.safety.plan_fresh_s, 0.5);
  EXPECT_EQ(params.safety.hover_limit_s, SafetyParams{}.hover_limit_s);
  EXPECT_EQ(load("").planning.horizon.plan_period_s, HorizonParams{}.plan_period_s);
}

TEST(LoadParams, NamesEveryFaultWithItsLine) {
  const std::string error = error_of(
      "safety:\n  plan_fresh_s: soon\n  no_such_s: 1\n  hover_limit_s: nan\n"
      "perception: 3\nflying: {}\nplanning:\n  plan_period_s: 99\n");
  EXPECT_THAT(error, AllOf(HasSubstr("params.yaml:2: safety.plan_fresh_s: 'soon' is not a number"),
                           HasSubstr(":3: safety.no_such_s: no such parameter"),
                           HasSubstr(":4: safety.hover_limit_s"),
                           HasSubstr(":5: perception: expected a mapping"),
                           HasSubstr(":6: flying: unknown stage; the stages are perception"),
                           HasSubstr(":8: planning.plan_period_s: 99 is not in")));
}

TEST(LoadParams, RefusesAKeyGivenTwiceAndAFileThatIsNotThere) {
  EXPECT_THAT(error_of("safety:\n  plan_fresh_s: 0.3\n  plan_fresh_s: 0.4\n"),
              HasSubstr(":3: safety.plan_fresh_s: given twice"));
  EXPECT_THAT(error_of("safety: {}\nsafety:\n  plan_fresh_s: 0.4\n"),
              HasSubstr(":2: safety: given twice"));
  EXPECT_THAT(error_of("safety: {}\n---\nsafety: {}\n"), HasSubstr(":3: 2 documents"));
  EXPECT_THAT(error_of("a: &a [*a]\n"), HasSubstr("foretrack_load_params.yaml"));
  EXPECT_THROW(load_params("/no/such/file.yaml"), std::invalid_argument);
}

TEST(LoadParams, ThePrintedFileLoadsAsItWasPrinted) {
  TrackerParams params;
  params.safety.plan_fresh_s = 0.4;
  TrackerParams again = load(yaml_of_params(params));
  EXPECT_EQ(yaml_of_params(again), yaml_of_params(params));
}

TEST(LoadParams, EveryShippedFileLoads) {
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator("deploy/params")) {
    if (entry.path().extension() != ".yaml") continue;
    ++files;
    EXPECT_NO_THROW(load_params(entry.path().string())) << entry.path();
  }
  EXPECT_GE(files, 3);
}

TEST(DescribeParams, HasARowForEveryParameterOfTheStage) {
  TrackerParams params;
  for (const auto& [stage, stage_rows] : stages_of(params)) {
    const std::string text = describe_params(params, stage);
    for (const auto& row : stage_rows) EXPECT_THAT(text, HasSubstr(std::string(row.name)));
  }
  EXPECT_THROW(describe_params(params, "nonsense"), std::invalid_argument);
}

TEST(StagesOf, EveryDefaultIsInItsRangeAndNamesAreUnique) {
  TrackerParams params;
  for (const auto& [stage, stage_rows] : stages_of(params)) {
    EXPECT_THAT(faults_of(stage_rows), testing::IsEmpty()) << stage;
    for (std::size_t i = 0; i < stage_rows.size(); ++i)
      for (std::size_t k = 0; k < i; ++k)
        EXPECT_NE(stage_rows[i].name, stage_rows[k].name) << stage;
  }
}

}  // namespace
}  // namespace foretrack
