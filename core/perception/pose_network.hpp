// SPDX-License-Identifier: Apache-2.0
// The two networks of BlazePose: the detector of people and the landmarks of one of them.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>

#include "core/network/inference.hpp"

namespace foretrack {

enum class PoseModel : int { kLite = 0, kFull = 1, kHeavy = 2 };

/// For one thread at a time.
struct PoseNetwork {
  std::unique_ptr<Inference> detector;
  std::unique_ptr<Inference> landmarks;
};

/// Reads pose_detection.tflite and pose_landmark_{lite,full,heavy}.tflite from a folder. Throws
/// std::runtime_error that names the file, what is wrong with it, and how to get it. Cost: about
/// 0.1 s.
PoseNetwork load_pose_network(const std::filesystem::path& folder, PoseModel model);

/// The same from the files' bytes; their names are for the messages.
PoseNetwork make_pose_network(std::span<const std::uint8_t> detector,
                              std::span<const std::uint8_t> landmarks);

}  // namespace foretrack
