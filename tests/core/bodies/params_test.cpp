// SPDX-License-Identifier: Apache-2.0
#include "core/bodies/params.hpp"

#include "tests/support/param_rows.hpp"

namespace foretrack::testing {

INSTANTIATE_TYPED_TEST_SUITE_P(Bodies, ParamRowsOf, BodyParams);

}  // namespace foretrack::testing
