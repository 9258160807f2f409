#pragma once

#include "tests/support/count_allocations.hpp"
