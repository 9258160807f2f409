#include "core/perception/pose_network.hpp"

#include <stdexcept>

namespace foretrack {

PoseNetwork load_pose_network(const std::filesystem::path& folder, PoseModel) {
  throw std::runtime_error(folder.string() + ": no networks yet");
}

}  // namespace foretrack
