// SPDX-License-Identifier: Apache-2.0
#include "core/prediction/params.hpp"

#include "tests/support/param_rows.hpp"

namespace foretrack::testing {

INSTANTIATE_TYPED_TEST_SUITE_P(Prediction, ParamRowsOf, PredictionParams);

}  // namespace foretrack::testing
