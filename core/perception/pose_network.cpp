// SPDX-License-Identifier: Apache-2.0
#include "core/perception/pose_network.hpp"

#include <array>
#include <fstream>
#include <stdexcept>
#include <vector>

#include "core/network/read_tflite.hpp"

namespace foretrack {
namespace {

constexpr std::size_t kMostBytes = 64u << 20;

struct Expected {
  const char* output;
  std::vector<int> shape;
};

std::vector<std::uint8_t> read_file(const std::filesystem::path& path) {
  std::error_code error;
  const auto size = std::filesystem::file_size(path, error);
  if (error) throw std::runtime_error(path.string() + ": no such file; ./run models fetches it");
  if (size > kMostBytes) throw std::runtime_error(path.string() + ": too big for a pose network");
  std::vector<std::uint8_t> bytes(size);
  std::ifstream file(path, std::ios::binary);
  file.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  if (!file) throw std::runtime_error(path.string() + ": cannot be read");
  return bytes;
}

std::unique_ptr<Inference> make_network(std::span<const std::uint8_t> file, const char* name,
                                        const std::vector<int>& input,
                                        const std::vector<Expected>& expected) {
  try {
    const NetworkModel model = read_tflite(file);
    std::vector<std::string> outputs;
    bool fits = model.tensors[model.input].shape == input;
    for (const Expected& e : expected) {
      outputs.emplace_back(e.output);
      for (const int k : model.outputs)
        fits = fits && (model.tensors[k].name != e.output || model.tensors[k].shape == e.shape);
    }
    if (!fits) throw std::runtime_error("another network (its input or outputs differ)");
    return make_xnnpack_inference(model, outputs);
  } catch (const std::exception& error) {
    throw std::runtime_error(std::string(name) + ": " + error.what());
  }
}

}  // namespace

PoseNetwork make_pose_network(std::span<const std::uint8_t> detector,
                              std::span<const std::uint8_t> landmarks) {
  PoseNetwork network;
  network.detector = make_network(detector, "person detector", {1, 224, 224, 3},
                                  {{"Identity", {1, 2254, 12}}, {"Identity_1", {1, 2254, 1}}});
  network.landmarks = make_network(landmarks, "landmark network", {1, 256, 256, 3},
                                   {{"Identity", {1, 195}},
                                    {"Identity_1", {1, 1}},
                                    {"Identity_3", {1, 64, 64, 39}},
                                    {"Identity_4", {1, 117}}});
  return network;
}

PoseNetwork load_pose_network(const std::filesystem::path& folder, PoseModel model) {
  constexpr std::array<const char*, 3> sizes = {"lite", "full", "heavy"};
  const auto landmarks = folder / (std::string("pose_landmark_") +
                                   sizes.at(static_cast<std::size_t>(model)) + ".tflite");
  try {
    return make_pose_network(read_file(folder / "pose_detection.tflite"), read_file(landmarks));
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(folder.string() + ": " + error.what());
  }
}

}  // namespace foretrack
