// SPDX-License-Identifier: Apache-2.0
#include "services/convert/image.hpp"

#include <cstring>

#include "convert_test_support.hpp"

namespace foretrack {
namespace {

using testing::kInf;
using testing::kNaN;
using ImageMsg = sensor_msgs::msg::Image;

CameraModel camera() {
  return CameraModel::from_fov(4, 3, rad(90), rad(75));
}

DepthImage image() {
  DepthImage d{2.5, camera(), {}};
  for (int i = 0; i < 12; ++i) d.depth_m.push_back(0.5f * static_cast<float>(i));
  return d;
}

ImageMsg message() {
  ImageMsg msg;
  to_idl(image(), msg);
  return msg;
}

TEST(DepthImageMessage, RoundTripsInMetres) {
  const auto out = from_idl(message(), camera());
  ASSERT_TRUE(out) << out.fault().text;
  EXPECT_EQ(out->stamp_s, 2.5);
  EXPECT_EQ(out->depth_m, image().depth_m);
  EXPECT_EQ(out->camera.width_px, 4);
}

TEST(DepthImageMessage, ReadsPaddedRowsOfMillimetres) {
  ImageMsg msg = message();
  msg.encoding("16UC1");
  msg.step(10);  // 8 bytes of pixels, 2 of padding
  msg.data().assign(30, 0xff);
  for (std::uint16_t i = 0; i < 12; ++i) {
    const std::uint16_t mm = 250 * i;
    std::memcpy(msg.data().data() + (i / 4) * 10 + (i % 4) * 2, &mm, 2);
  }
  const auto out = from_idl(msg, camera());
  ASSERT_TRUE(out) << out.fault().text;
  for (int i = 0; i < 12; ++i) EXPECT_FLOAT_EQ(out->depth_m[i], 0.25f * i);
}

TEST(DepthImageMessage, NegativeAndNaNDepthsAreNoReturns) {
  DepthImage in = image();
  in.depth_m[0] = -1.0f;
  in.depth_m[1] = static_cast<float>(kNaN);
  in.depth_m[2] = static_cast<float>(kInf);
  ImageMsg msg;
  to_idl(in, msg);
  const auto out = from_idl(msg, camera());
  ASSERT_TRUE(out);
  EXPECT_EQ(out->depth_m[0], 0.0f);
  EXPECT_EQ(out->depth_m[1], 0.0f);
  EXPECT_EQ(out->depth_m[2], static_cast<float>(kInf));
}

TEST(DepthImageMessage, ReusesTheBuffer) {
  std::vector<float> buffer(12);
  const float* memory = buffer.data();
  const auto out = from_idl(message(), camera(), std::move(buffer));
  ASSERT_TRUE(out);
  EXPECT_EQ(out->depth_m.data(), memory);
}

TEST(DepthImageMessage, RefusesEachBadField) {
  using M = ImageMsg;
  testing::expect_each_refused<M>(message(),
                                  {
                                      {"header.stamp", [](M& m) { m.header().stamp().sec(-1); }},
                                      {"encoding", [](M& m) { m.encoding("rgb8"); }},
                                      {"is_bigendian", [](M& m) { m.is_bigendian(1); }},
                                      {"width", [](M& m) { m.width(5); }},
                                      {"height", [](M& m) { m.height(4'000'000'000u); }},
                                      {"step", [](M& m) { m.step(15); }},
                                      {"step", [](M& m) { m.step(4'000'000'000u); }},
                                      {"data", [](M& m) { m.data().pop_back(); }},
                                      {"data", [](M& m) { m.data().clear(); }},
                                      {"data", [](M& m) { m.data().resize(100000); }},
                                  },
                                  [](const M& m) { return from_idl(m, camera()); });
}

TEST(DepthImageMessage, Mono16IsMillimetresToo) {
  ImageMsg msg = message();
  msg.encoding("mono16");
  msg.step(8);
  msg.data().assign(24, 0);
  msg.data()[0] = 0xE8, msg.data()[1] = 0x03;
  const auto out = from_idl(msg, camera());
  ASSERT_TRUE(out) << out.fault().text;
  EXPECT_FLOAT_EQ(out->depth_m[0], 1.0F);
}

}  // namespace
}  // namespace foretrack
