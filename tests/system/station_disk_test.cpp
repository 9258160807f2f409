// SPDX-License-Identifier: Apache-2.0
// Recording onto a disk that fills up, while a vehicle flies.
#include <sys/mount.h>

#include "services/launch/domain.hpp"
#include "tests/system/station_program.hpp"

namespace foretrack {
namespace {

/// A disk of 2 MB, in memory.
class SmallDisk {
 public:
  explicit SmallDisk(std::filesystem::path path) : path_(std::move(path)) {
    std::filesystem::create_directories(path_);
    mounted_ = mount("tmpfs", path_.c_str(), "tmpfs", 0, "size=2m") == 0;
  }
  ~SmallDisk() {
    if (mounted_) umount2(path_.c_str(), MNT_DETACH);
  }
  bool mounted() const { return mounted_; }
  std::string path() const { return path_.string(); }

 private:
  std::filesystem::path path_;
  bool mounted_ = false;
};

TEST(StationOnAFullDisk, SaysSoKeepsWhatItWroteAndTheVehicleFliesOn) {
  if (!has_npm_packages()) GTEST_SKIP() << "npm ci was not run in " << kWeb;
  Folder folder;
  const SmallDisk disk(folder.path / "disk");
  if (!disk.mounted()) GTEST_SKIP() << "a small disk can be mounted by root only";
  const FreeDomain domain;
  const auto id = std::to_string(domain.id());
  Program flight({"up", "--scenario", "t_intersection", "--domain", id, "--out",
                  (folder.path / "up").string()},
                 folder.path / "up.out");
  Station station({"station", "--domain", id, "--enable-control", "--recordings", disk.path()},
                  folder.path);
  ASSERT_TRUE(eventually([&] { return !station.vehicle().is_null(); }, 60.0));
  ASSERT_EQ(station.post("/api/record", {{"action", "start"}})["ok"], true);
  EXPECT_TRUE(station.status()["recording_fault"].is_null());
  ASSERT_TRUE(eventually([&] { return station.status()["recording_fault"].is_string(); }, 60.0));
  const auto status = station.status();
  EXPECT_TRUE(status["recording"].is_null());
  EXPECT_NE(status["recording_fault"].get<std::string>().find("No space left"), std::string::npos);

  std::filesystem::path file;
  for (const auto& entry : std::filesystem::directory_iterator(disk.path())) file = entry.path();
  const Json report = probe("mcap.mjs", {file.string()});
  ASSERT_TRUE(report["streamed"].contains("messages")) << report["streamed"];
  EXPECT_GT(report["streamed"]["messages"], 100);
  EXPECT_GT(std::filesystem::file_size(file), 1'000'000u);

  // Samples still come, and so do orders.
  const auto age = [&](const char* name) {
    const auto now = station.status();
    for (const auto& topic : now["topics"])
      if (topic["topic"] == name) return topic["age_s"].get<double>();
    return 1e9;
  };
  EXPECT_TRUE(eventually([&] { return age("/uav1/safety/state") < 1.0; }, 10.0));
  const Json stop = {{"vehicle", "uav1"}, {"operator", "ada"}, {"command", "stop"}};
  EXPECT_EQ(station.post("/api/command", stop)["ok"], true);
}

}  // namespace
}  // namespace foretrack
