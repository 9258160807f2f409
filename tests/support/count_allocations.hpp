// Counts every operator new of the test program.
#pragma once

namespace foretrack {

long allocation_count();

}  // namespace foretrack
