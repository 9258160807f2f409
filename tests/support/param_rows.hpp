// SPDX-License-Identifier: Apache-2.0
// Whether the rows of a params struct say all of it: tests for every stage's.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <set>
#include <string>
#include <vector>

#include "core/common/params.hpp"

namespace foretrack::testing {

/// The byte at which a struct of doubles, ints and bools has something that no row shows; −1: the
/// rows, and what alignment puts between them, are all of it.
template <class Params>
std::ptrdiff_t first_hidden_byte(Params& params) {
  struct Field {
    std::ptrdiff_t at, size;
  };
  std::vector<Field> fields;
  for (const ParamRow& row : rows(params))
    std::visit(
        [&](auto* value) {
          fields.push_back(
              {reinterpret_cast<const char*>(value) - reinterpret_cast<const char*>(&params),
               static_cast<std::ptrdiff_t>(sizeof *value)});
        },
        row.value);
  std::sort(fields.begin(), fields.end(),
            [](const Field& a, const Field& b) { return a.at < b.at; });
  fields.push_back({static_cast<std::ptrdiff_t>(sizeof params), alignof(Params)});
  std::ptrdiff_t end = 0;
  for (const Field& f : fields) {
    if (f.at != (end + f.size - 1) / f.size * f.size) return end;
    end = f.at + f.size;
  }
  return -1;
}

/// The first name that two rows have; empty: all differ.
inline std::string repeated_name(const ParamRows& rows) {
  std::set<std::string_view> names;
  for (const ParamRow& row : rows)
    if (!names.insert(row.name).second) return std::string(row.name);
  return {};
}

/// Each stage instantiates this for its params.
template <class Params>
class ParamRowsOf : public ::testing::Test {};
TYPED_TEST_SUITE_P(ParamRowsOf);

TYPED_TEST_P(ParamRowsOf, EveryFieldHasOneRowAndAValidDefault) {
  TypeParam params;
  EXPECT_EQ(first_hidden_byte(params), -1);
  EXPECT_EQ(repeated_name(rows(params)), "");
  EXPECT_TRUE(faults_of(rows(params)).empty());
}

TYPED_TEST_P(ParamRowsOf, EveryRowSaysWhatItMeans) {
  TypeParam params;
  for (const ParamRow& row : rows(params)) EXPECT_FALSE(row.meaning.empty()) << row.name;
}

REGISTER_TYPED_TEST_SUITE_P(ParamRowsOf, EveryFieldHasOneRowAndAValidDefault,
                            EveryRowSaysWhatItMeans);

}  // namespace foretrack::testing
