// SPDX-License-Identifier: Apache-2.0
// What a viewer sees of a video, and how far it is from what was put in.
#pragma once

#if __has_include(<wels/codec_api.h>)
#include <wels/codec_api.h>
#endif

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>

#include "core/common/image.hpp"

namespace foretrack::testing {

/// Peak signal to noise, over all pixels and colours of both. Precondition: of one size.
inline double psnr_db(const RgbImage& a, const RgbImage& b) {
  double squares = 0.0;
  for (std::size_t i = 0; i < a.rgb.size(); ++i) squares += std::pow(a.rgb[i] - b.rgb[i], 2);
  return 10.0 * std::log10(255.0 * 255.0 * static_cast<double>(a.rgb.size()) / squares);
}

#if __has_include(<wels/codec_api.h>)
/// OpenH264's own decoder, as a viewer that has just come.
class H264Decoder {
 public:
  H264Decoder() {
    WelsCreateDecoder(&decoder_);
    int quiet = WELS_LOG_QUIET;
    decoder_->SetOption(DECODER_OPTION_TRACE_LEVEL, &quiet);
    SDecodingParam params{};
    params.sVideoProperty.eVideoBsType = VIDEO_BITSTREAM_AVC;
    params.eEcActiveIdc = ERROR_CON_DISABLE;
    decoder_->Initialize(&params);
  }
  ~H264Decoder() {
    decoder_->Uninitialize();
    WelsDestroyDecoder(decoder_);
  }
  H264Decoder(const H264Decoder&) = delete;
  H264Decoder& operator=(const H264Decoder&) = delete;

  /// None: these bytes are no whole picture, or one that it leans on is missing.
  std::optional<RgbImage> decode(std::span<const std::uint8_t> picture) {
    unsigned char* planes[3] = {};
    SBufferInfo info{};
    const auto state = decoder_->DecodeFrameNoDelay(
        picture.data(), static_cast<int>(picture.size()), planes, &info);
    if (state != dsErrorFree || info.iBufferStatus != 1) return std::nullopt;
    return rgb_of(planes, info.UsrData.sSystemBuffer);
  }

 private:
  // BT.601, limited range, as the video says.
  static RgbImage rgb_of(unsigned char* const planes[3], const SSysMEMBuffer& at) {
    RgbImage out{at.iWidth, at.iHeight, std::vector<std::uint8_t>(3ul * at.iWidth * at.iHeight)};
    const auto byte = [](double x) {
      return static_cast<std::uint8_t>(std::clamp(std::lround(x), 0l, 255l));
    };
    for (int row = 0; row < out.height_px; ++row)
      for (int column = 0; column < out.width_px; ++column) {
        const double y = 1.164 * (planes[0][row * at.iStride[0] + column] - 16);
        const int half = row / 2 * at.iStride[1] + column / 2;
        const double u = planes[1][half] - 128, v = planes[2][half] - 128;
        std::uint8_t* to = out.pixel(column, row);
        to[0] = byte(y + 1.596 * v);
        to[1] = byte(y - 0.392 * u - 0.813 * v);
        to[2] = byte(y + 2.017 * u);
      }
    return out;
  }

  ISVCDecoder* decoder_ = nullptr;
};
#endif

}  // namespace foretrack::testing
