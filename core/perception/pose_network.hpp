// SPDX-License-Identifier: Apache-2.0
// The two networks of BlazePose: the detector of people and the landmarks of one of them.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>

#include "core/network/inference.hpp"

namespace foretrack {

/// The size of the landmark network: the larger, the more accurate and the slower.
enum class PoseModel : int { kLite = 0, kFull = 1, kHeavy = 2 };

/// Both networks with their memory. For one thread at a time.
struct PoseNetwork {
  std::unique_ptr<Inference> detector;   ///< 224 × 224 pixels → where people are
  std::unique_ptr<Inference> landmarks;  ///< 256 × 256 pixels → landmarks of one person
};

/// Reads pose_detection.tflite and pose_landmark_{lite,full,heavy}.tflite from a folder. Throws
/// std::runtime_error that names the file, what is wrong with it, and how to get it. Cost: about
/// 0.1 s.
PoseNetwork load_pose_network(const std::filesystem::path& folder, PoseModel model);

/// The same from the bytes of the two files. Throws std::runtime_error that says which of the two
/// is not the network that is expected, and why.
PoseNetwork make_pose_network(std::span<const std::uint8_t> detector,
                              std::span<const std::uint8_t> landmarks);

}  // namespace foretrack
