// SPDX-License-Identifier: Apache-2.0
// Pictures that are read, looked at and drawn on.
#include <gmock/gmock.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "services/files/models/pose_models.hpp"
#include "services/files/share/share.hpp"
#include "services/offline/images/frame_sink.hpp"
#include "services/offline/images/person_finder.hpp"
#include "tests/services/offline/images/scratch_folder.hpp"

namespace foretrack {
namespace {

using ::testing::HasSubstr;

template <class Call>
std::string trouble_of(Call call) {
  try {
    call();
  } catch (const std::exception& error) {
    return error.what();
  }
  return "";
}

TEST(LoadPicture, SaysWhatIsWrongWithAFile) {
  const testing::ScratchFolder folder;
  const std::string picture = std::string(FORETRACK_SOURCE_DIR) + "/tests/data/basketball.png";
  std::ifstream whole(picture, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(whole), {}};
  const auto trouble = [](const std::string& file) {
    return trouble_of([&] { load_picture(file); });
  };
  EXPECT_THAT(trouble(folder.file("none.png")), HasSubstr("no such file"));
  EXPECT_THAT(trouble(folder.write("empty.png", "")), HasSubstr("empty"));
  EXPECT_THAT(trouble(folder.write("text.png", "hello")), HasSubstr("not a picture"));
  EXPECT_THAT(trouble(folder.write("cut.png", bytes.substr(0, 30))), HasSubstr("not a picture"));
  EXPECT_EQ(load_picture(picture).width_px, 640);
}

TEST(OpenSource, SaysWhatIsWrongWithAVideoOrCamera) {
  const testing::ScratchFolder folder;
  EXPECT_THAT(trouble_of([&] { open_video(folder.file("none.mp4")); }), HasSubstr("no such file"));
  EXPECT_THAT(trouble_of([&] { open_video(folder.write("bad.mp4", "x")); }),
              HasSubstr("not a video"));
  EXPECT_THAT(trouble_of([] { open_camera("/dev/nothing"); }), HasSubstr("/dev/nothing"));
  EXPECT_THAT(trouble_of([] { open_sink("drawing.svg", 30.0); }), HasSubstr(".png"));
}

// A Matroska file, by hand: a JPEG a frame, each with a stamp of its own, in milliseconds.
class Matroska {
 public:
  Matroska(int width_px, int height_px) {
    using namespace std::string_literals;
    add(0x1A45DFA3, element(0x4282, "matroska"s));
    const std::string video = element(0xB0, number(width_px)) + element(0xBA, number(height_px));
    const std::string track = element(0xD7, number(1)) + element(0x73C5, number(1)) +
                              element(0x83, number(1)) + element(0x86, "V_MJPEG"s) +
                              element(0xE0, video);
    inside_ = element(0x1549A966, element(0x2AD7B1, number(1000000))) +
              element(0x1654AE6B, element(0xAE, track));
    cluster_ = element(0xE7, number(0));
  }
  void add_frame(int stamp_ms, const std::string& jpeg) {
    const std::string head = {'\x81', static_cast<char>(stamp_ms >> 8),
                              static_cast<char>(stamp_ms & 0xFF), '\x80'};
    cluster_ += element(0xA3, head + jpeg);
  }
  std::string file() const {
    return text_ + element(0x18538067, inside_ + element(0x1F43B675, cluster_));
  }

 private:
  static std::string number(std::uint64_t value, int bytes = 4) {
    std::string text;
    for (int i = bytes - 1; i >= 0; --i) text += static_cast<char>(value >> (8 * i));
    return text;
  }
  static std::string element(std::uint64_t id, const std::string& content) {
    const int bytes = id > 0xFFFFFF ? 4 : id > 0xFFFF ? 3 : id > 0xFF ? 2 : 1;
    return number(id, bytes) + number(0x0100000000000000 | content.size(), 8) + content;
  }
  void add(std::uint64_t id, const std::string& content) { text_ += element(id, content); }
  std::string text_, inside_, cluster_;
};

TEST(VideoSource, KeepsTheStampsOfAVaryingRate) {
  const testing::ScratchFolder folder;
  RgbImage image{64, 48, {}};
  image.rgb.assign(3 * 64 * 48, 90);
  open_sink(folder.file("frame.jpg"), 30.0)->write(image);
  std::ifstream in(folder.file("frame.jpg"), std::ios::binary);
  const std::string jpeg{std::istreambuf_iterator<char>(in), {}};
  Matroska video(64, 48);
  const std::vector<int> stamps_ms = {100, 133, 166, 600, 700, 1900};
  for (const int stamp_ms : stamps_ms) video.add_frame(stamp_ms, jpeg);
  const auto source = open_video(folder.write("varying.mkv", video.file()));
  for (const int stamp_ms : stamps_ms) {
    const auto frame = source->next();
    ASSERT_TRUE(frame);
    EXPECT_NEAR(frame->stamp_s, 1e-3 * (stamp_ms - 100), 2e-3);
  }
  EXPECT_FALSE(source->next());
}

// With the real networks, if they were fetched.
class Pictures : public ::testing::TestWithParam<int> {
 protected:
  void SetUp() override {
    const std::string trouble =
        trouble_of([&] { network_ = load_shipped_pose_network(GetParam()); });
    if (trouble.find("./run models") != std::string::npos) GTEST_SKIP() << trouble;
    ASSERT_EQ(trouble, "");
  }
  PoseNetwork network_;
  PerceptionParams params_;
};

RgbImage plain(int width_px, int height_px, std::uint8_t level) {
  RgbImage image{width_px, height_px, {}};
  image.rgb.assign(3u * width_px * height_px, level);
  return image;
}

std::string find_picture(const std::string& name) {
  for (const std::string& folder : {std::string(FORETRACK_SOURCE_DIR) + "/tests/data/",
                                    std::string("/usr/share/doc/opencv-doc/examples/data/"),
                                    std::string("/usr/lib/python3/dist-packages/skimage/data/")})
    if (std::filesystem::exists(folder + name)) return folder + name;
  return "";
}

// Landmarks of @mediapipe/pose itself; made by bench/blazepose/reference.mjs --compact.
TEST_P(Pictures, LandmarksAreThoseOfTheOriginal) {
  std::ifstream file(std::string(FORETRACK_SOURCE_DIR) + "/tests/data/blazepose_reference.json");
  const auto reference = nlohmann::json::parse(file);
  int compared = 0;
  for (const auto& entry : reference) {
    const std::string picture = find_picture(entry["picture"]);
    if (entry["model"] != GetParam() || picture.empty()) continue;
    const RgbImage image = load_picture(picture);
    PoseState state;
    for (std::size_t frame = 0; frame < entry["frames"].size(); ++frame) {
      const auto result =
          perceive_image(state, image, 0.1 * static_cast<double>(frame), network_, params_);
      ASSERT_TRUE(result.found()) << picture;
      std::vector<double> misses_px;
      for (int k = 0; k < kLandmarkCount; ++k) {
        const auto& row = entry["frames"][frame][k];
        const Landmark& landmark = result.person.landmarks[k];
        misses_px.push_back((landmark.image_px - Vec2(row[0], row[1])).norm());
        EXPECT_NEAR(landmark.visibility, row[2], 0.01);
        EXPECT_LT((landmark.body_m - Vec3(row[3], row[4], row[5])).norm(), 2e-3);
        ++compared;
      }
      std::nth_element(misses_px.begin(), misses_px.begin() + 16, misses_px.end());
      EXPECT_LT(misses_px[16], 0.02) << picture << ", frame " << frame;
    }
  }
  EXPECT_GT(compared, 0);
}

TEST_P(Pictures, NobodyIsSeenInBlackWhiteTinyAndHugePictures) {
  EXPECT_TRUE(find_people(plain(640, 480, 0), network_, params_).empty());
  EXPECT_TRUE(find_people(plain(640, 480, 255), network_, params_).empty());
  EXPECT_TRUE(find_people(plain(1, 1, 128), network_, params_).empty());
  EXPECT_TRUE(find_people(plain(8000, 20, 128), network_, params_).empty());
  EXPECT_TRUE(find_people(plain(7680, 4320, 60), network_, params_).empty());
  EXPECT_TRUE(find_people({}, network_, params_).empty());
}

TEST_P(Pictures, FrameAfterFrameThePersonStaysWhereTheyStand) {
  const RgbImage image = load_picture(find_picture("basketball.png"));
  PoseState state;
  Vec2 first = Vec2::Zero();
  for (int k = 0; k < 10; ++k) {
    const auto result = perceive_image(state, image, 0.03 * k, network_, params_);
    ASSERT_EQ(result.status, k == 0 ? PoseStatus::kDetected : PoseStatus::kTracked);
    if (k == 0) first = result.person.torso_px();
    EXPECT_LT((result.person.torso_px() - first).norm(), 6.0);
  }
}

INSTANTIATE_TEST_SUITE_P(EveryModel, Pictures, ::testing::Values(0, 1, 2));

TEST(PersonFinder, RefusesACalibrationOfAnotherSize) {
  PersonFinder finder({}, {}, CameraWithLens{});
  EXPECT_THAT(trouble_of([&] {
                finder.look({0.0, "a.png", plain(320, 240, 0)});
              }),
              HasSubstr("a.png: the image has 320 × 240 pixels, the calibration 640 × 480"));
}

TEST(PeopleJson, HasTheFieldsOfItsContract) {
  SeenFrame frame{1.5, "", {SeenPerson{}}};
  frame.people[0].place = BodyInCamera{{0.1, 0.2, 3.0}, 1.0};
  const auto json = json_of(frame);
  EXPECT_EQ(json["stamp_s"], 1.5);
  const auto& person = json["people"][0];
  EXPECT_EQ(person["landmarks"].size(), 33u);
  for (const char* key : {"x_px", "y_px", "visibility", "world_m"})
    EXPECT_TRUE(person["landmarks"][0].contains(key)) << key;
  EXPECT_EQ(person["position_camera_m"][2], 3.0);
  EXPECT_EQ(person["yaw_rad"], 1.0);
  EXPECT_TRUE(person.contains("score"));
}

TEST(FrameSink, WritesAPictureThatCanBeReadAgain) {
  const testing::ScratchFolder folder;
  RgbImage image = plain(64, 48, 200);
  PersonPose person;
  for (int k = 0; k < kLandmarkCount; ++k)
    person.landmarks[k] = {{30.0 + k, 20.0}, Vec3::Zero(), 1.0};
  draw_person(image, person, "99 %");
  open_sink(folder.file("out.png"), 0.0)->write(image);
  EXPECT_EQ(load_picture(folder.file("out.png")).rgb, image.rgb);
  EXPECT_NE(image.rgb, plain(64, 48, 200).rgb);
}

}  // namespace
}  // namespace foretrack
