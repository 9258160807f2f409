// SPDX-License-Identifier: Apache-2.0
// Counts every operator new of the test program.
#pragma once

namespace foretrack {

long allocation_count();

}  // namespace foretrack
