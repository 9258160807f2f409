// SPDX-License-Identifier: Apache-2.0
#include "core/perception/stream_params.hpp"

#include "tests/support/param_rows.hpp"

namespace foretrack::testing {

INSTANTIATE_TYPED_TEST_SUITE_P(Stream, ParamRowsOf, StreamParams);

}  // namespace foretrack::testing
