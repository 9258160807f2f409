// SPDX-License-Identifier: Apache-2.0
#include "core/planning/plan_params.hpp"

#include "tests/support/param_rows.hpp"

namespace foretrack::testing {

INSTANTIATE_TYPED_TEST_SUITE_P(Planning, ParamRowsOf, PlanningParams);

}  // namespace foretrack::testing
