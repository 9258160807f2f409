// SPDX-License-Identifier: Apache-2.0
// What our networks make of tensors, for tensors.mjs to compare with what the original runtime
// does.
//   pose_tensors FOLDER [--random N] [PICTURE...]
// Inputs are what the pipeline feeds of each picture (the whole of it to the detector, the region
// of everybody found, and the region that follows from it, to the landmark networks), and N seeded
// random ones. Files: FOLDER/NETWORK.CASE.input and one of each output, 32-bit floats.
#include <filesystem>
#include <fstream>

#include "bench/run_bench.hpp"
#include "core/common/random.hpp"
#include "core/perception/detect_people.hpp"
#include "core/perception/find_landmarks.hpp"
#include "services/files/models/pose_models.hpp"
#include "services/offline/images/frame_source.hpp"

namespace {

using namespace foretrack;
namespace fs = std::filesystem;

constexpr double kLeastScore = 0.5;

struct Options {
  std::string folder;
  int random = 5;
  std::vector<std::string> pictures;
};

void write(const fs::path& file, std::span<const float> values) {
  std::ofstream out(file, std::ios::binary);
  out.write(reinterpret_cast<const char*>(values.data()),
            static_cast<std::streamsize>(values.size_bytes()));
  if (!out) throw std::runtime_error(file.string() + ": cannot be written");
}

// A network and how its files are named.
struct Subject {
  Inference& network;
  fs::path folder;
  std::string name;
  std::vector<std::string> outputs;
  double low = 0.0;  // of the input; up to 1

  void write_last(const std::string& input_case) const {
    const auto file = [&](const std::string& tensor) -> fs::path {
      return folder / (name + "." + input_case + "." + tensor);
    };
    write(file("input"), network.input());
    for (std::size_t k = 0; k < outputs.size(); ++k) write(file(outputs[k]), network.output(k));
  }

  void run_random(int count) const {
    for (int k = 1; k <= count; ++k) {
      Random random(static_cast<std::uint64_t>(k));
      for (float& value : network.input()) value = static_cast<float>(random.uniform(low, 1.0));
      network.run();
      write_last("random-" + std::to_string(k));
    }
  }
};

std::vector<Detection> run_detector(const Subject& detector, const RgbImage& image,
                                    const std::string& picture) {
  auto people = detect_people(image, whole_of(image), detector.network, kLeastScore);
  detector.write_last(picture);
  return people;
}

void run_landmarks(const Subject& landmarks, const RgbImage& image, const Detection& person,
                   const std::string& picture) {
  const auto found = find_landmarks(image, region_of_body(person), landmarks.network, kLeastScore);
  landmarks.write_last(picture + "-detected");
  if (found && find_landmarks(image, found->tracked, landmarks.network, kLeastScore))
    landmarks.write_last(picture + "-tracked");
}

int run(const Options& o) {
  fs::create_directories(o.folder);
  for (const int model : {0, 1, 2}) {
    PoseNetwork network = load_shipped_pose_network(model);
    constexpr std::array kSizes = {"lite", "full", "heavy"};
    const Subject detector{
        *network.detector, o.folder, "pose_detection", {"Identity", "Identity_1"}, -1.0};
    const Subject landmarks{*network.landmarks,
                            o.folder,
                            std::string("pose_landmark_") + kSizes.at(model),
                            {"Identity", "Identity_1", "Identity_3", "Identity_4"}};
    for (const std::string& file : o.pictures) {
      const RgbImage image = load_picture(file);
      const std::string picture = fs::path(file).stem();
      int number = 0;
      for (const Detection& person : run_detector(detector, image, picture))
        run_landmarks(landmarks, image, person, picture + "-" + std::to_string(++number));
    }
    if (model == 0) detector.run_random(o.random);
    landmarks.run_random(o.random);
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  Options o;
  CLI::App app("inputs and outputs of the pose networks as raw tensors");
  app.add_option("folder", o.folder, "where the tensors go")->required();
  app.add_option("--random", o.random, "seeded random inputs of each network")
      ->capture_default_str();
  app.add_option("pictures", o.pictures)->check(CLI::ExistingFile);
  return run_bench(app, argc, argv, [&] { return run(o); });
}
