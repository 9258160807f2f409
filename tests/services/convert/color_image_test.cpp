// SPDX-License-Identifier: Apache-2.0
#include "services/convert/color_image.hpp"

#include "convert_test_support.hpp"
#include "services/convert/image.hpp"
#include "tests/fuzz/mutate.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace foretrack {
namespace {

using ImageMsg = sensor_msgs::msg::Image;

CameraModel camera() {
  return CameraModel::from_fov(4, 3, rad(90), rad(75));
}

RgbImage image() {
  RgbImage out{4, 3, {}};
  for (int k = 0; k < 36; ++k) out.rgb.push_back(static_cast<std::uint8_t>(7 * k));
  return out;
}

ImageMsg message() {
  ImageMsg out;
  to_idl(image(), 2.5, out);
  return out;
}

TEST(ColorImageMessage, RoundTrips) {
  const auto out = rgb_from_idl(message(), camera());
  ASSERT_TRUE(out) << out.fault().text;
  EXPECT_EQ(out->rgb, image().rgb);
}

TEST(ColorImageMessage, ReadsPaddedRowsOfEachEncoding) {
  const RgbImage truth = image();
  for (const auto& [encoding, width] : {std::pair{"rgb8", 3}, {"bgr8", 3}, {"mono8", 1}}) {
    ImageMsg in = message();
    in.encoding(encoding);
    in.step(4 * width + 5);
    in.data().assign(3 * in.step(), 0xee);
    for (int row = 0; row < 3; ++row)
      for (int column = 0; column < 4; ++column)
        for (int k = 0; k < width; ++k)
          in.data()[row * in.step() + width * column + k] =
              truth.pixel(column, row)[in.encoding() == "bgr8" ? 2 - k : k];
    const auto out = rgb_from_idl(in, camera());
    ASSERT_TRUE(out) << out.fault().text;
    for (int row = 0; row < 3; ++row)
      for (int column = 0; column < 4; ++column)
        for (int k = 0; k < 3; ++k)
          EXPECT_EQ(out->pixel(column, row)[k], truth.pixel(column, row)[width == 1 ? 0 : k]);
  }
}

TEST(ColorImageMessage, NamesWhatItRefuses) {
  const auto fault = [](auto change) {
    ImageMsg in = message();
    change(in);
    const auto out = rgb_from_idl(in, camera());
    return out ? std::string("none") : std::string(out.fault().field);
  };
  EXPECT_EQ(fault([](ImageMsg& m) { m.encoding("bayer_rggb8"); }), "encoding");
  EXPECT_EQ(fault([](ImageMsg& m) { m.encoding(""); }), "encoding");
  EXPECT_EQ(fault([](ImageMsg& m) { m.width(5); }), "width");
  EXPECT_EQ(fault([](ImageMsg& m) { m.height(0); }), "height");
  EXPECT_EQ(fault([](ImageMsg& m) { m.step(11); }), "step");
  EXPECT_EQ(fault([](ImageMsg& m) { m.step(4000000000u); }), "step");
  EXPECT_EQ(fault([](ImageMsg& m) { m.data().pop_back(); }), "data");
  EXPECT_EQ(fault([](ImageMsg& m) { m.data().clear(); }), "data");
  EXPECT_EQ(fault([](ImageMsg& m) { m.data().push_back(0); }), "data");
  EXPECT_EQ(fault([](ImageMsg&) {}), "none");
}

TEST(ColorImageMessage, NoBytesLeadOutsideOrCrash) {
  std::vector<std::uint8_t> good = {4, 0, 0, 0, 3, 0, 0, 0, 12, 0, 0, 0, 0, 4, 3, 0};
  good.resize(16 + 36, 99);
  testing::Mutator mutator(1);
  for (int k = 0; k < 20000; ++k) {
    const auto bytes = mutator.mutate(good);
    LLVMFuzzerTestOneInput(bytes.data(), bytes.size());
  }
}

// One colour a row of each: red, green, grey.
TEST(ColorImageMessage, ReadsWhatCamerasWrite) {
  struct Case {
    const char* encoding;
    std::vector<std::uint8_t> red, grey;  // two pixels
  };
  const std::vector<Case> cases = {
      {"rgba8", {255, 0, 0, 9, 255, 0, 0, 9}, {90, 90, 90, 9, 90, 90, 90, 9}},
      {"bgra8", {0, 0, 255, 9, 0, 0, 255, 9}, {90, 90, 90, 9, 90, 90, 90, 9}},
      {"yuv422", {90, 81, 240, 81}, {128, 93, 128, 93}},
      {"yuv422_yuy2", {81, 90, 81, 240}, {93, 128, 93, 128}}};
  for (const Case& c : cases) {
    ImageMsg in = message();
    in.encoding(c.encoding);
    in.step(static_cast<std::uint32_t>(2 * c.red.size()));
    in.data().clear();
    for (const auto* pixels : {&c.red, &c.red, &c.grey, &c.grey, &c.red, &c.red})
      in.data().insert(in.data().end(), pixels->begin(), pixels->end());
    const auto out = rgb_from_idl(in, camera());
    ASSERT_TRUE(out) << out.fault().text;
    for (int column = 0; column < 4; ++column) {
      EXPECT_NEAR(out->pixel(column, 0)[0], 255, 2) << c.encoding;
      EXPECT_NEAR(out->pixel(column, 0)[1], 0, 2) << c.encoding;
      for (int k = 0; k < 3; ++k) EXPECT_NEAR(out->pixel(column, 1)[k], 90, 1) << c.encoding;
    }
  }
}

TEST(ColorImageMessage, SixteenBitsOfGreyAreLittleEndian) {
  ImageMsg in = message();
  in.encoding("mono16");
  in.step(8);
  in.data().assign(24, 0);
  in.data()[1] = 200;
  EXPECT_EQ(rgb_from_idl(in, camera())->pixel(0, 0)[2], 200);
  in.is_bigendian(1);
  EXPECT_EQ(rgb_from_idl(in, camera()).fault().field, "is_bigendian");
}

}  // namespace
}  // namespace foretrack
