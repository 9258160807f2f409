// SPDX-License-Identifier: Apache-2.0
#include "core/common/params.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

namespace foretrack {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

struct Example {
  double length_m = 1.5;
  int count = 3;
  bool enabled = true;
};

ParamRows rows(Example& e) {
  return {{"length_m", &e.length_m, "m", 0.0, 10.0, "how long"},
          {"count", &e.count, "1", 1, 5, "how many"},
          {"enabled", &e.enabled, "1", 0, 1, "whether"}};
}

TEST(Params, DefaultsAreValid) {
  Example example;
  EXPECT_THAT(faults_of(rows(example)), IsEmpty());
  EXPECT_NO_THROW(validate_or_throw("example", rows(example)));
}

TEST(Params, EveryFaultIsReportedAtOnce) {
  Example example{std::numeric_limits<double>::quiet_NaN(), 6, false};
  EXPECT_EQ(faults_of(rows(example)).size(), 2u);
  try {
    validate_or_throw("example", rows(example));
    FAIL() << "must throw";
  } catch (const std::invalid_argument& error) {
    EXPECT_THAT(error.what(), HasSubstr("example"));
    EXPECT_THAT(error.what(), HasSubstr("length_m"));
    EXPECT_THAT(error.what(), HasSubstr("count: 6 is not in [1, 5]"));
  }
}

TEST(Params, TextSetsEachKind) {
  Example example;
  EXPECT_EQ(set_param(rows(example), "length_m", "2.25"), "");
  EXPECT_EQ(set_param(rows(example), "count", "4"), "");
  EXPECT_EQ(set_param(rows(example), "enabled", "false"), "");
  EXPECT_EQ(example.length_m, 2.25);
  EXPECT_EQ(example.count, 4);
  EXPECT_FALSE(example.enabled);
}

TEST(Params, TextRoundTrips) {
  Example example{0.1, 2, false}, copy;
  for (const auto& row : rows(example))
    EXPECT_EQ(set_param(rows(copy), row.name, text_of(row)), "");
  EXPECT_EQ(copy.length_m, example.length_m);
  EXPECT_EQ(copy.count, example.count);
  EXPECT_EQ(copy.enabled, example.enabled);
}

TEST(Params, AFlagMayHaveWordsOfItsOwn) {
  bool by_network = true;
  const ParamRows rows = {{"short_term", &by_network, "filter|network", 0, 0, "who tells"}};
  EXPECT_EQ(text_of(rows[0]), "network");
  EXPECT_EQ(set_param(rows, "short_term", "filter"), "");
  EXPECT_FALSE(by_network);
  EXPECT_EQ(text_of(rows[0]), "filter");
  EXPECT_THAT(set_param(rows, "short_term", "true"), HasSubstr("not network or filter"));
}

TEST(Params, EachBadTextIsAFault) {
  Example example;
  EXPECT_THAT(set_param(rows(example), "length_m", "far"), HasSubstr("not a number"));
  EXPECT_THAT(set_param(rows(example), "length_m", "1.5m"), HasSubstr("not a number"));
  EXPECT_THAT(set_param(rows(example), "length_m", ""), HasSubstr("not a number"));
  EXPECT_THAT(set_param(rows(example), "length_m", "nan"), HasSubstr("is not in"));
  EXPECT_THAT(set_param(rows(example), "length_m", "10.5"), HasSubstr("is not in"));
  EXPECT_THAT(set_param(rows(example), "count", "2.5"), HasSubstr("not a whole number"));
  EXPECT_THAT(set_param(rows(example), "enabled", "1"), HasSubstr("not true or false"));
  EXPECT_THAT(set_param(rows(example), "width_m", "1"), HasSubstr("no such parameter"));
}

}  // namespace
}  // namespace foretrack
