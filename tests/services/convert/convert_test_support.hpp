// SPDX-License-Identifier: Apache-2.0
// Faults planted in good messages: each must be refused, naming its field.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "services/convert/geometry.hpp"

namespace foretrack::testing {

inline constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
inline constexpr double kInf = std::numeric_limits<double>::infinity();

template <class Msg>
struct PlantedFault {
  const char* field;  // as the refusal names it
  std::function<void(Msg&)> plant;
};

/// `convert` is from_idl or a call of it.
template <class Msg, class Convert>
void expect_each_refused(const Msg& good, const std::vector<PlantedFault<Msg>>& faults,
                         Convert convert) {
  {
    const auto accepted = convert(good);
    ASSERT_TRUE(accepted) << accepted.fault().text;
  }
  for (std::size_t i = 0; i < faults.size(); ++i) {
    Msg bad = good;
    faults[i].plant(bad);
    const auto refused = convert(bad);
    ASSERT_FALSE(refused) << "fault " << i << " (" << faults[i].field << ") was accepted";
    EXPECT_EQ(refused.fault().field, faults[i].field) << "fault " << i;
    EXPECT_THAT(refused.fault().text, ::testing::HasSubstr("expected")) << "fault " << i;
  }
}

template <class Msg>
std::vector<PlantedFault<Msg>> header_faults() {
  return {{"header.stamp", [](Msg& m) { m.header().stamp().sec(-1); }},
          {"header.stamp", [](Msg& m) { m.header().stamp().nanosec(1'000'000'000u); }},
          {"header.frame_id", [](Msg& m) { m.header().frame_id("odom"); }},
          {"header.frame_id", [](Msg& m) { m.header().frame_id(std::string(100000, 'x')); }}};
}
template <class Msg>
std::vector<PlantedFault<Msg>> operator+(std::vector<PlantedFault<Msg>> a,
                                         std::vector<PlantedFault<Msg>> b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

}  // namespace foretrack::testing
