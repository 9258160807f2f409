// SPDX-License-Identifier: Apache-2.0
#include "services/files/config/load_vehicle.hpp"

#include <gmock/gmock.h>

#include <fstream>

#include "services/files/config/load_params.hpp"
#include "tests/support/error_of.hpp"
#include "tests/support/folder.hpp"

namespace foretrack {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr char kGood[] = R"(vehicle:
  preset: realsense
  remap: ["odometry:=mavros/local_position/odom"]
  px4: "1.17"
  base_frame: fcu
  odometry_is_map: true
  depth_mount: [0.1, 0, -0.05, 0, 0.2, 0]
safety:
  plan_fresh_s: 0.4
)";

struct File : foretrack::testing::Folder {
  explicit File(const std::string& text) { std::ofstream(path / "file.yaml") << text; }
  std::string name() const { return (path / "file.yaml").string(); }
};

TEST(LoadVehicle, StandsBesideTheStages) {
  const File file(kGood);
  const VehicleSection section = load_vehicle(file.name());
  EXPECT_THAT(section.presets, ElementsAre("realsense"));
  EXPECT_THAT(section.remaps, ElementsAre("odometry:=mavros/local_position/odom"));
  EXPECT_EQ(section.px4, "1.17");
  EXPECT_EQ(section.base_frame, "fcu");
  EXPECT_EQ(section.odometry_is_map, true);
  EXPECT_THAT(section.depth_mount, ElementsAre(0.1, 0, -0.05, 0, 0.2, 0));
  EXPECT_THAT(section.color_mount, IsEmpty());
  EXPECT_EQ(load_params(file.name()).safety.plan_fresh_s, 0.4);
}

TEST(LoadVehicle, NamesEveryFaultWithItsLine) {
  const File file("vehicle:\n  px5: 1\n  depth_mount: [1, 2]\n  remap: {a: b}\n");
  EXPECT_THAT(error_of([&] { return load_vehicle(file.name()); }),
              AllOf(HasSubstr(":2: vehicle.px5: unknown key"),
                    HasSubstr(":3: vehicle.depth_mount: is a list, expected a list of 6 numbers"),
                    HasSubstr(":4: vehicle.remap: is a mapping")));
  EXPECT_THAT(load_vehicle(File("safety: {}\n").name()).remaps, IsEmpty());
}

}  // namespace
}  // namespace foretrack
