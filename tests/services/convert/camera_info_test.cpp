// SPDX-License-Identifier: Apache-2.0
#include "services/convert/camera_info.hpp"

#include "convert_test_support.hpp"

namespace foretrack {
namespace {

using testing::kInf;
using testing::kNaN;
using M = sensor_msgs::msg::CameraInfo;

CameraModel camera() {
  return CameraModel::from_fov(4, 3, rad(90), rad(75));
}

M message() {
  M out;
  to_idl(camera(), 1.0, out);
  return out;
}

TEST(CameraInfoMessage, RoundTrips) {
  const auto out = from_idl(message());
  ASSERT_TRUE(out) << out.fault().text;
  EXPECT_EQ(out->camera.width_px, 4);
  EXPECT_EQ(out->camera.fx_px, camera().fx_px);
  EXPECT_EQ(out->camera.fy_px, camera().fy_px);
  EXPECT_EQ(out->camera.cx_px, camera().cx_px);
  EXPECT_EQ(out->camera.cy_px, camera().cy_px);
  EXPECT_FALSE(out->lens.distorts());
}

TEST(CameraInfoMessage, RefusesEachBadField) {
  testing::expect_each_refused<M>(
      message(),
      {
          {"header.stamp", [](M& m) { m.header().stamp().nanosec(~0u); }},
          {"width", [](M& m) { m.width(0); }},
          {"height", [](M& m) { m.height(1'000'000); }},
          {"k", [](M& m) { m.k()[0] = 0.0; }},
          {"k", [](M& m) { m.k()[4] = kNaN; }},
          {"k", [](M& m) { m.k()[2] = kInf; }},
          {"k", [](M& m) { m.k()[2] = 9.0; }},
          {"k", [](M& m) { m.k() = {}; }},
          {"k", [](M& m) { m.k()[0] = m.k()[4] = 9000.0; }},
          {"d", [](M& m) { m.d()[0] = kNaN; }},
          {"d", [](M& m) { m.distortion_model("origami"); }},
      },
      [](const M& m) { return from_idl(m); });
}

TEST(CameraInfoMessage, ReadsTheLensesThatDriversWrite) {
  M info = message();
  info.d({-0.3, 0.1, 0.0, 0.0, 0.0});
  const auto out = from_idl(info);
  ASSERT_TRUE(out) << out.fault().text;
  EXPECT_TRUE(out->lens.distorts());
  info.distortion_model("none");
  info.d().clear();
  EXPECT_FALSE(from_idl(info)->lens.distorts());
  info.distortion_model("rational_polynomial");
  info.d().assign(8, 0.0);
  EXPECT_TRUE(from_idl(info));
  info.distortion_model("equidistant");
  info.d().assign(4, 0.0);
  EXPECT_EQ(from_idl(info)->lens.model, Lens::Model::kEquidistant);
}

}  // namespace
}  // namespace foretrack
