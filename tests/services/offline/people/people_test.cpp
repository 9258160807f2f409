// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "services/offline/people/archive.hpp"
#include "services/offline/people/load_person.hpp"
#include "services/offline/people/read_obj.hpp"

namespace foretrack {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

bool installed() {
  return fs::is_regular_file(kPeopleFile);
}

TEST(ReadObj, TurnsPolygonsIntoTrianglesWithTheBodysAxes) {
  std::vector<std::string> materials;
  const PersonMesh mesh = read_obj(
      "# a square\nv 1 2 3\nv 4 2 3\r\nv 4 5 3\nv 1 5 3\nvt 0 0.5\nvn 0 0 1\n"
      "usemtl cloth\nf 1/1/1 2/1/1 3/1/1 -1/1/1\n",
      materials);
  EXPECT_THAT(materials, ::testing::ElementsAre("cloth"));
  ASSERT_EQ(mesh.triangles.size(), 2U);
  ASSERT_EQ(mesh.vertices.size(), 4U);
  EXPECT_EQ(mesh.vertices[0].position, Eigen::Vector3f(3, 1, 2));  // forward, left, up
  EXPECT_EQ(mesh.vertices[0].normal, Eigen::Vector3f(1, 0, 0));
  EXPECT_EQ(mesh.vertices[0].v, 0.5F);
  EXPECT_EQ(mesh.triangles[1].vertices, (std::array<int, 3>{0, 2, 3}));
}

TEST(ReadObj, NamesTheLineOfAFault) {
  std::vector<std::string> materials;
  const auto fault = [&](const char* text, const char* message) {
    EXPECT_THAT([&] { read_obj(text, materials); },
                ThrowsMessage<std::runtime_error>(HasSubstr(message)))
        << text;
  };
  fault("v 1 2\n", "line 1: a number");
  fault("v 1 2 nan\n", "line 1: a number");
  fault("v 1 2 3\nf 1 1 2\n", "line 2: an index is out of range");
  fault("v 1 2 3\nf 1 1\n", "line 2: a face needs three");
  fault("v 1 2 3\nf 1/x 1 1\n", "line 2: an index");
}

TEST(ReadObj, ReadsMaterials) {
  const auto materials = read_mtl("newmtl a\nKd 0.5 0.25 1\nmap_Kd a.jpg\nnewmtl b\n");
  EXPECT_EQ(materials.at("a").picture, "a.jpg");
  EXPECT_EQ(materials.at("a").color.y(), 0.25F);
  EXPECT_EQ(materials.at("b").picture, "");
}

TEST(LoadPerson, SaysWhichPackageIsMissing) {
  EXPECT_THAT(
      [] { load_person("boy", "/nowhere/people.sh3f"); },
      ThrowsMessage<std::runtime_error>(::testing::AllOf(
          HasSubstr("/nowhere/people.sh3f"), HasSubstr("apt-get install sweethome3d-furniture"))));
}

TEST(LoadPerson, NamesThePeopleThatThereAre) {
  EXPECT_THAT([] { load_person("nobody"); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("there are boy, girl, man, suit")));
}

TEST(LoadPerson, RefusesWhatIsNoArchive) {
  const fs::path file = fs::temp_directory_path() / ("people_test." + std::to_string(getpid()));
  std::ofstream(file) << "this is no zip";
  EXPECT_THAT([&] { load_person("boy", file); },
              ThrowsMessage<std::runtime_error>(HasSubstr(file.string())));
  fs::remove(file);
}

TEST(LoadPerson, EverybodyStandsOnTheGroundAndIsAsTallAsAsked) {
  if (!installed()) GTEST_SKIP() << kPeopleFile << " is not installed";
  for (const std::string& name : person_names()) {
    const auto model = load_person(name);
    EXPECT_GT(model->mesh.triangles.size(), 8000U) << name;
    PersonState standing;
    standing.position_enu_m.z() = torso_height_m(1.8);
    std::vector<Corner> posed;
    pose_person(*model, joints_enu_m(standing, 1.8), 1.8, posed);
    float low = 9.0F, high = -9.0F;
    for (const Corner& corner : posed) {
      low = std::min(low, corner.camera_m.z());
      high = std::max(high, corner.camera_m.z());
      EXPECT_LT(corner.camera_m.head<2>().norm(), 0.55F) << name;
    }
    EXPECT_NEAR(low, 0.0, 0.04) << name;
    EXPECT_NEAR(high, 1.8, 0.04) << name;
  }
}

}  // namespace
}  // namespace foretrack
