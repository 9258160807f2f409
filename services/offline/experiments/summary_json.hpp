// SPDX-License-Identifier: Apache-2.0
// The figures of a bench as JSON: summary.json.
#pragma once

#include <string>

#include "services/offline/experiments/summarize.hpp"

namespace foretrack {

/// {"cells": […], "scenes": […], "comparisons": […], "scene_comparisons": […]}; fields as in
/// docs/metrics.md. Infinite numbers are null.
std::string summary_json_of(const BenchResults& results);

}  // namespace foretrack
