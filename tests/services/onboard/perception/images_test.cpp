// SPDX-License-Identifier: Apache-2.0
// Images on DDS: from pixels to the person's state, with the real network.
#include "foretrack_msgs/msg/TargetObservation.h"
#include "services/convert/image.hpp"
#include "services/convert/target.hpp"
#include "services/files/models/pose_models.hpp"
#include "services/offline/images/frame_source.hpp"
#include "services/onboard/perception/perception_service.hpp"
#include "tests/services/onboard/neighbours.hpp"

namespace foretrack::testing {
namespace {

class ImagesOnDds : public ::testing::Test {
 protected:
  void SetUp() override {
    neighbours_.vehicle.position_enu_m = {0.0, 0.0, 1.5};
    camera_.fx_px = camera_.fy_px = 600.0;
    try {
      load_shipped_pose_network(0);
    } catch (const std::exception& error) {
      GTEST_SKIP() << error.what();
    }
    picture_ = load_picture(FORETRACK_SOURCE_DIR "/tests/data/basketball.png");
  }
  void feed(const RgbImage& image, double age_s = 0.0) {
    neighbours_.send_odometry();
    const double stamp_s = neighbours_.now_s() - age_s;
    to_idl(camera_, stamp_s, info_.sample());
    info_.write();
    to_idl(image, stamp_s, image_.sample());
    image_.write();
  }
  bool says(TrackStatus status) {
    const auto state =
        target_.take_newest_as([](const auto& message) { return from_idl(message); });
    if (state) newest_ = *state;
    return state && newest_.status == status;
  }
  bool refused(const char* reason) { return neighbours_.refused("camera/color/image", reason) > 0; }

  CameraModel camera_;
  RgbImage picture_;
  Neighbours neighbours_;
  Writer<topics::ColorImage> image_{neighbours_.node()};
  Writer<topics::ColorCameraInfo> info_{neighbours_.node()};
  Reader<topics::TargetState> target_{neighbours_.node()};
  Reader<topics::TargetObservation> observation_{neighbours_.node()};
  Running service_{[](const ServiceOptions& options, Stop& stop) {
    run_perception(options, PerceptionParams{}, BodyParams{}, ChoiceParams{}, StreamParams{}, stop);
  }};
  TargetState newest_;
};

TEST_F(ImagesOnDds, APersonInImagesIsTrackedAndTheirLandmarksArePublished) {
  ASSERT_TRUE(
      neighbours_.until([&] { return says(TrackStatus::kTracking); }, [&] { feed(picture_); }));
  // At the left of the image, a few metres ahead.
  EXPECT_GT(newest_.position_enu_m.x(), 2.0);
  EXPECT_LT(newest_.position_enu_m.x(), 8.0);
  EXPECT_GT(newest_.position_enu_m.y(), 0.5);
  const auto* message = observation_.take_newest();
  ASSERT_NE(message, nullptr);
  EXPECT_EQ(message->landmarks().size(), 33u);
}

TEST_F(ImagesOnDds, AnEmptyImageMakesTheTrackCoastAndThePersonIsFoundAgain) {
  RgbImage black = picture_;
  std::fill(black.rgb.begin(), black.rgb.end(), 0);
  ASSERT_TRUE(
      neighbours_.until([&] { return says(TrackStatus::kTracking); }, [&] { feed(picture_); }));
  ASSERT_TRUE(
      neighbours_.until([&] { return says(TrackStatus::kCoasting); }, [&] { feed(black); }));
  ASSERT_TRUE(
      neighbours_.until([&] { return says(TrackStatus::kTracking); }, [&] { feed(picture_); }));
}

TEST_F(ImagesOnDds, DoubtAboutWhoIsFollowedIsSaidInHealth) {
  // The man at the left stands at the right, too.
  RgbImage two = picture_;
  const auto row = static_cast<std::size_t>(two.width_px) * 3;
  for (std::size_t begin = 0; begin < two.rgb.size(); begin += row)
    for (std::size_t pixel = 0; pixel < 3 * 240; pixel += 3)
      std::copy_n(&two.rgb[begin + pixel], 3, &two.rgb[begin + row - 3 - pixel]);
  Reader<topics::ServiceHealth> health{neighbours_.node()};
  std::string trouble;
  const auto doubts = [&] {
    health.take_each([&](const auto& m) { trouble = m.last_error().c_str(); });
    return trouble.starts_with("several people could be the one who is followed");
  };
  EXPECT_TRUE(neighbours_.until(doubts, [&] { feed(two); })) << trouble;
}

TEST_F(ImagesOnDds, BadAndLateImagesAreRefusedByNameAndGoodOnesStillCount) {
  const auto send_bad = [&] {
    feed(picture_, 1.0);
    auto& message = image_.sample();
    const auto send = [&](auto change) {
      to_idl(picture_, neighbours_.now_s(), message);
      change(message);
      image_.write();
    };
    send([](auto& m) { m.encoding("yuv422"); });
    send([](auto& m) { m.step(7); });
    send([](auto& m) { m.data().clear(); });
    send([](auto& m) { m.width(639); });
  };
  // Only the newest of those that wait is looked at, so that which one is refused varies.
  ASSERT_TRUE(neighbours_.until([&] { return refused(""); }, send_bad));
  ASSERT_TRUE(neighbours_.until([&] { return refused("late"); }, [&] { feed(picture_, 1.0); }));
  ASSERT_TRUE(
      neighbours_.until([&] { return says(TrackStatus::kTracking); }, [&] { feed(picture_); }));
}

}  // namespace
}  // namespace foretrack::testing
