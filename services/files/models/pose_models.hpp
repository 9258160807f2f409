// SPDX-License-Identifier: Apache-2.0
// The files of the pose networks: where they are, and whether they are what they should be.
#pragma once

#include "core/perception/pose_network.hpp"

namespace foretrack {

/// The networks of a model (complexity 0, 1, 2: lite, full, heavy) from the shipped folder
/// `models`, checked against their SHA-256 (deploy/models/SHA256SUMS). Throws std::runtime_error
/// that says what is missing or wrong, and how to get it. Cost: 0.1 to 0.5 s.
PoseNetwork load_shipped_pose_network(int model_complexity);

}  // namespace foretrack
