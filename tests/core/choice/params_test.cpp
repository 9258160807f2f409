// SPDX-License-Identifier: Apache-2.0
#include "core/choice/params.hpp"

#include "tests/support/param_rows.hpp"

namespace foretrack::testing {

INSTANTIATE_TYPED_TEST_SUITE_P(Choice, ParamRowsOf, ChoiceParams);

}  // namespace foretrack::testing
