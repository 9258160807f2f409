// SPDX-License-Identifier: Apache-2.0
// Fuzz target: any bytes as an image's size, step, encoding and pixels.
#include <cstdint>
#include <cstring>
#include <stdexcept>

#include "services/convert/color_image.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace foretrack;
  constexpr std::size_t kHeader = 16;
  if (size < kHeader) return 0;
  std::uint32_t numbers[3];
  std::memcpy(numbers, data, sizeof numbers);
  constexpr const char* kEncodings[] = {"rgb8",  "bgr8",        "mono8",  "yuv422",
                                        "bgra8", "yuv422_yuy2", "mono16", "bayer_rggb8"};
  sensor_msgs::msg::Image message;
  message.width(numbers[0] % 40000);
  message.height(numbers[1] % 40000);
  message.step(numbers[2]);
  message.encoding(kEncodings[data[12] % 8]);
  message.data().assign(data + kHeader, data + size);
  CameraModel camera;
  camera.width_px = data[13];
  camera.height_px = data[14];
  const auto image = rgb_from_idl(message, camera);
  const std::size_t expected =
      3 * static_cast<std::size_t>(camera.width_px) * static_cast<std::size_t>(camera.height_px);
  if (image && image->rgb.size() != expected) throw std::logic_error("another size");
  return 0;
}
