// SPDX-License-Identifier: Apache-2.0
#include "services/common/parameters.hpp"

#include <gmock/gmock.h>

namespace foretrack {
namespace {

using namespace rcl_interfaces::msg::ParameterValue_Constants;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

struct Fields {
  double rate_hz = 10.0;
  int width_px = 640;
  bool enabled = true;
};

ParamRows rows_of(Fields& f) {
  return {{"rate_hz", &f.rate_hz, "Hz", 1.0, 30.0, "how often"},
          {"width_px", &f.width_px, "px", 16, 4096, "how wide"},
          {"enabled", &f.enabled, "1", 0, 1, "whether"}};
}

rcl_interfaces::msg::Parameter number(const std::string& name, double value) {
  rcl_interfaces::msg::Parameter parameter;
  parameter.name(name);
  parameter.value().type(PARAMETER_DOUBLE);
  parameter.value().double_value(value);
  return parameter;
}

struct InFlight : ::testing::Test {
  InFlight() { parameters.add("stream", rows_of(fields), Change::kInFlight); }
  Fields fields;
  Parameters parameters;
};

TEST_F(InFlight, AreListedByPrefixAndDepthAsRos2Asks) {
  const std::vector<std::string> all = {"stream.enabled", "stream.rate_hz", "stream.width_px"};
  EXPECT_EQ(parameters.list({}, 0).names(), all);
  EXPECT_EQ(parameters.list({"stream"}, 0).names(), all);
  EXPECT_EQ(parameters.list({"stream"}, 1).names(), all);
  EXPECT_TRUE(parameters.list({}, 1).names().empty()) << "all are two parts deep";
  EXPECT_TRUE(parameters.list({"strea"}, 0).names().empty());
  EXPECT_THAT(parameters.list({"stream.rate_hz"}, 0).names(), ElementsAre("stream.rate_hz"));
  EXPECT_THAT(parameters.list({}, 0).prefixes(), ElementsAre("stream"));
}

TEST_F(InFlight, AreDescribedWithUnitMeaningAndRange) {
  const auto d = parameters.describe("stream.rate_hz");
  EXPECT_EQ(d.type(), PARAMETER_DOUBLE);
  EXPECT_EQ(d.description(), "how often [Hz]");
  ASSERT_EQ(d.floating_point_range().size(), 1u);
  EXPECT_EQ(d.floating_point_range()[0].to_value(), 30.0);
  EXPECT_FALSE(d.read_only());
  EXPECT_EQ(parameters.describe("stream.width_px").integer_range()[0].from_value(), 16);
  EXPECT_EQ(parameters.describe("nope").type(), PARAMETER_NOT_SET);
}

TEST_F(InFlight, ChangeTheFieldItself) {
  EXPECT_EQ(parameters.set(number("stream.rate_hz", 5.0)), "");
  EXPECT_EQ(fields.rate_hz, 5.0);
  EXPECT_EQ(parameters.get("stream.rate_hz").double_value(), 5.0);
}

TEST_F(InFlight, TakeAWholeNumberForOneWithFractions) {
  rcl_interfaces::msg::Parameter whole;
  whole.name("stream.rate_hz");
  whole.value().type(PARAMETER_INTEGER);
  whole.value().integer_value(7);
  EXPECT_EQ(parameters.set(whole), "");
  EXPECT_EQ(fields.rate_hz, 7.0);
}

TEST_F(InFlight, RefuseWithAReasonWhatDoesNotFitAndKeepTheirValue) {
  EXPECT_THAT(parameters.set(number("stream.rate_hz", 31.0)), HasSubstr("31 is not within 1 … 30"));
  EXPECT_THAT(parameters.set(number("stream.rate_hz", std::nan(""))), HasSubstr("not within"));
  EXPECT_THAT(parameters.set(number("stream.width_px", 100.0)), HasSubstr("another type"));
  EXPECT_THAT(parameters.set(number("stream.nope", 1.0)), HasSubstr("no parameter 'stream.nope'"));
  EXPECT_EQ(fields.rate_hz, 10.0);
  EXPECT_EQ(fields.width_px, 640);
}

TEST(AtStart, AreReadOnlyAndSayHowTheyAreChanged) {
  Fields fields;
  Parameters parameters;
  parameters.add("planning", rows_of(fields), Change::kAtStart);
  EXPECT_TRUE(parameters.describe("planning.rate_hz").read_only());
  EXPECT_THAT(parameters.set(number("planning.rate_hz", 5.0)), HasSubstr("--params"));
  EXPECT_EQ(fields.rate_hz, 10.0);
}

}  // namespace
}  // namespace foretrack
