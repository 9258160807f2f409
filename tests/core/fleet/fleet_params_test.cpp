// SPDX-License-Identifier: Apache-2.0
#include "core/fleet/fleet_params.hpp"

#include "tests/support/param_rows.hpp"

namespace foretrack::testing {

INSTANTIATE_TYPED_TEST_SUITE_P(Fleet, ParamRowsOf, FleetParams);

}  // namespace foretrack::testing
