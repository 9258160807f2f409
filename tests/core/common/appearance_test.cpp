// SPDX-License-Identifier: Apache-2.0
#include "core/common/appearance.hpp"

#include <gtest/gtest.h>

namespace foretrack {
namespace {

// Red above, grey below, blue legs, in a light of this brightness (its logarithm).
Appearance dressed(double brightness = 0.0) {
  Appearance a;
  a.colors << 0.6, 0.1, 1.5, 0.0, 0.0, 1.3;
  a.legs << 0.0, 0.5, 1.2, 0.0, 0.5, 1.2;
  a.legs_seen = true;
  for (const int k : {2, 5}) {
    a.colors[k] += brightness;
    a.legs[k] += brightness;
  }
  return a;
}

TEST(LastingDifference, IsLittleInAnotherLight) {
  EXPECT_EQ(lasting_difference(dressed(), dressed()), 0.0);
  EXPECT_LT(lasting_difference(dressed(), dressed(0.2)), 0.05);
  EXPECT_GT(difference(dressed(), dressed(0.2)), 0.25) << "from image to image it is one light";
}

TEST(LastingDifference, CountsColoursAndContrastsOfEachPart) {
  for (const int k : {0, 1, 3, 4}) {
    Appearance other = dressed();
    other.colors[k] += 0.3;
    EXPECT_NEAR(lasting_difference(dressed(), other), 0.3, 1e-9);
    other = dressed();
    other.legs[k] += 0.3;
    EXPECT_NEAR(lasting_difference(dressed(), other), 0.3, 1e-9);
  }
  Appearance dark_trousers = dressed();
  dark_trousers.legs[2] -= 0.4;
  dark_trousers.legs[5] -= 0.4;
  EXPECT_NEAR(lasting_difference(dressed(), dark_trousers), 0.2, 1e-9);
}

TEST(LastingDifference, WithoutLegsTheTorsoDecides) {
  Appearance other = dressed();
  other.legs.setConstant(9.0);
  other.legs_seen = false;
  EXPECT_EQ(lasting_difference(dressed(), other), 0.0);
  EXPECT_EQ(lasting_difference(other, dressed()), 0.0);
}

TEST(LastingDifference, LegsAreLearntFromWhenTheyAreSeen) {
  Appearance known = dressed();
  known.legs_seen = false;
  known.legs.setZero();
  learn(known, dressed(), 0.1);
  EXPECT_TRUE(known.legs_seen);
  EXPECT_EQ(known.legs, dressed().legs);
  Appearance other = dressed();
  other.legs[0] = 1.0;
  learn(known, other, 0.1);
  EXPECT_NEAR(known.legs[0], 0.1, 1e-12);
  other.legs_seen = false;
  other.legs[0] = 5.0;
  learn(known, other, 0.5);
  EXPECT_NEAR(known.legs[0], 0.1, 1e-12);
}

TEST(LastingDifference, HeightsCountWhereBothAreKnownAndMoreThanAnImageIsWrongBy) {
  Appearance man = dressed(), other = dressed();
  man.height_m = 1.78;
  EXPECT_EQ(lasting_difference(man, other), 0.0) << "of the other it is not known";
  other.height_m = 1.74;
  EXPECT_EQ(lasting_difference(man, other), 0.0);
  other.height_m = 1.30;
  EXPECT_GT(lasting_difference(man, other), 0.5) << "a child";
  EXPECT_EQ(lasting_difference(man, other), lasting_difference(other, man));
}

TEST(LastingDifference, HeightsAreLearntFromWhenTheyAreSeen) {
  Appearance known = dressed(), seen = dressed();
  learn(known, seen, 0.1);
  EXPECT_TRUE(std::isnan(known.height_m));
  seen.height_m = 1.7;
  learn(known, seen, 0.1);
  EXPECT_EQ(known.height_m, 1.7);
  seen.height_m = 1.8;
  learn(known, seen, 0.1);
  EXPECT_NEAR(known.height_m, 1.71, 1e-12);
}

}  // namespace
}  // namespace foretrack
