// SPDX-License-Identifier: Apache-2.0
#include "core/planning/motion/flight_limits.hpp"

#include "tests/support/param_rows.hpp"

namespace foretrack::testing {

INSTANTIATE_TYPED_TEST_SUITE_P(FlightLimits, ParamRowsOf, FlightLimits);

}  // namespace foretrack::testing
