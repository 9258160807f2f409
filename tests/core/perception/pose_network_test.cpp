// SPDX-License-Identifier: Apache-2.0
#include "core/perception/pose_network.hpp"

#include <gmock/gmock.h>
#include <unistd.h>

#include <fstream>

#include "tests/core/network/tiny_tflite.hpp"

namespace foretrack {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

template <class Call>
std::string fault_of(Call&& call) {
  try {
    call();
    return "none";
  } catch (const std::runtime_error& error) {
    return error.what();
  }
}

/// A folder of its own, that is gone after the test.
struct Folder {
  std::filesystem::path path = std::filesystem::temp_directory_path() /
                               ("foretrack_pose_network_" + std::to_string(::getpid()));
  Folder() { std::filesystem::create_directory(path); }
  ~Folder() { std::filesystem::remove_all(path); }
  void write(const char* name, const std::string& text) const {
    std::ofstream(path / name) << text;
  }
};

TEST(LoadPoseNetwork, NamesTheFileThatIsMissingAndHowToGetIt) {
  const Folder folder;
  folder.write("pose_landmark_lite.tflite", "anything");
  EXPECT_THAT(fault_of([&] { load_pose_network(folder.path, PoseModel::kLite); }),
              AllOf(HasSubstr("pose_detection.tflite"), HasSubstr("./run models")));
  folder.write("pose_detection.tflite", "anything");
  std::filesystem::remove(folder.path / "pose_landmark_lite.tflite");
  for (const auto& [model, name] : {std::pair{PoseModel::kLite, "lite"},
                                    {PoseModel::kFull, "full"},
                                    {PoseModel::kHeavy, "heavy"}})
    EXPECT_THAT(fault_of([&] { load_pose_network(folder.path, model); }),
                HasSubstr(std::string("pose_landmark_") + name + ".tflite"));
}

TEST(LoadPoseNetwork, SaysWhichOfTheFilesIsNoNetwork) {
  const Folder folder;
  folder.write("pose_detection.tflite", "not a network at all");
  folder.write("pose_landmark_lite.tflite", "nor is this");
  EXPECT_THAT(fault_of([&] { load_pose_network(folder.path, PoseModel::kLite); }),
              AllOf(HasSubstr(folder.path.string()), HasSubstr("person detector"),
                    HasSubstr("no 'TFL3' file")));
}

TEST(MakePoseNetwork, RefusesANetworkOfOtherInputsAndOutputs) {
  const auto tiny = testing::tiny_tflite();
  EXPECT_THAT(fault_of([&] { make_pose_network(tiny, tiny); }),
              AllOf(HasSubstr("person detector"), HasSubstr("another network")));
}

}  // namespace
}  // namespace foretrack
