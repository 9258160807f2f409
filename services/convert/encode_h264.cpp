// SPDX-License-Identifier: Apache-2.0
#include "services/convert/encode_h264.hpp"

#ifdef FORETRACK_OPENH264

#include <wels/codec_api.h>

#include <cmath>

#include "services/convert/i420.hpp"

namespace foretrack {
namespace {

constexpr double kKey_s = 1.0;      // between key pictures, at most
constexpr int kLeastPx = 16;        // OpenH264 asks for it
constexpr int kBestQuantizer = 20;  // better is not seen, and fills the link

struct EndEncoder {
  void operator()(ISVCEncoder* encoder) const {
    encoder->Uninitialize();
    WelsDestroySVCEncoder(encoder);
  }
};
using EncoderPtr = std::unique_ptr<ISVCEncoder, EndEncoder>;

int bits_s(const VideoWish& wish) {
  return static_cast<int>(std::lround(1000.0 * wish.bandwidth_kbit_s));
}

void describe(const I420Image& picture, const VideoWish& wish, SEncParamExt& out) {
  out.iUsageType = CAMERA_VIDEO_REAL_TIME;
  out.iPicWidth = picture.width_px;
  out.iPicHeight = picture.height_px;
  out.iTargetBitrate = bits_s(wish);
  out.iRCMode = RC_BITRATE_MODE;
  out.fMaxFrameRate = static_cast<float>(wish.rate_hz);
  out.iComplexityMode = LOW_COMPLEXITY;
  out.uiIntraPeriod = 0;  // by the stamps, see encode()
  out.iMultipleThreadIdc = 1;
  out.iMinQp = kBestQuantizer;
  out.bEnableFrameSkip = false;  // who asks has thinned them
  SSpatialLayerConfig& layer = out.sSpatialLayers[0];
  layer.iVideoWidth = out.iPicWidth;
  layer.iVideoHeight = out.iPicHeight;
  layer.fFrameRate = out.fMaxFrameRate;
  layer.iSpatialBitrate = out.iTargetBitrate;
  layer.uiProfileIdc = PRO_BASELINE;
  layer.sSliceArgument.uiSliceMode = SM_SINGLE_SLICE;
  // Unless the video says so, decoders guess its colours by its size.
  layer.bVideoSignalTypePresent = true;
  layer.uiVideoFormat = VF_UNDEF;
  layer.bColorDescriptionPresent = true;
  layer.uiColorPrimaries = CP_SMPTE170M;
  layer.uiTransferCharacteristics = TRC_SMPTE170M;
  layer.uiColorMatrix = CM_SMPTE170M;
}

EncoderPtr begin(const I420Image& picture, const VideoWish& wish) {
  ISVCEncoder* made = nullptr;
  if (WelsCreateSVCEncoder(&made) != 0) return nullptr;
  EncoderPtr encoder(made);
  int quiet = WELS_LOG_QUIET;
  encoder->SetOption(ENCODER_OPTION_TRACE_LEVEL, &quiet);
  SEncParamExt params;
  encoder->GetDefaultParams(&params);
  describe(picture, wish, params);
  return encoder->InitializeExt(&params) == cmResultSuccess ? std::move(encoder) : nullptr;
}

void append(const SFrameBSInfo& encoded, std::vector<std::uint8_t>& out) {
  for (int i = 0; i < encoded.iLayerNum; ++i) {
    const SLayerBSInfo& layer = encoded.sLayerInfo[i];
    int bytes = 0;
    for (int unit = 0; unit < layer.iNalCount; ++unit) bytes += layer.pNalLengthInByte[unit];
    out.insert(out.end(), layer.pBsBuf, layer.pBsBuf + bytes);
  }
}

}  // namespace

bool has_video_encoder() {
  return true;
}

struct H264Encoder::Impl {
  I420Image picture;
  EncoderPtr encoder;
  int width_px = 0, height_px = 0;  // that it was begun with
  VideoWish last;
  double begin_s = 0.0, key_s = 0.0;

  bool prepare(const VideoWish& wish);
  bool encode(const VideoWish& wish, std::vector<std::uint8_t>& out);
};

bool H264Encoder::Impl::prepare(const VideoWish& wish) {
  if (picture.width_px < kLeastPx || picture.height_px < kLeastPx) return false;
  const bool goes_on = encoder && width_px == picture.width_px && height_px == picture.height_px &&
                       last.rate_hz == wish.rate_hz && wish.stamp_s > last.stamp_s;
  if (!goes_on) {
    encoder = begin(picture, wish);
    width_px = picture.width_px;
    height_px = picture.height_px;
    begin_s = key_s = wish.stamp_s;
  } else if (wish.bandwidth_kbit_s != last.bandwidth_kbit_s) {
    SBitrateInfo bandwidth{SPATIAL_LAYER_ALL, bits_s(wish)};
    encoder->SetOption(ENCODER_OPTION_BITRATE, &bandwidth);
  }
  return encoder != nullptr;
}

bool H264Encoder::Impl::encode(const VideoWish& wish, std::vector<std::uint8_t>& out) {
  if (wish.readers > last.readers || wish.stamp_s - key_s >= kKey_s) encoder->ForceIntraFrame(true);
  SSourcePicture source{};
  source.iColorFormat = videoFormatI420;
  source.iPicWidth = picture.width_px;
  source.iPicHeight = picture.height_px;
  source.iStride[0] = picture.width_px;
  source.iStride[1] = source.iStride[2] = picture.width_px / 2;
  source.pData[0] = picture.y();
  source.pData[1] = picture.u();
  source.pData[2] = picture.v();
  source.uiTimeStamp = std::llround(1000.0 * (wish.stamp_s - begin_s));
  SFrameBSInfo encoded{};
  if (encoder->EncodeFrame(&source, &encoded) != cmResultSuccess) return false;
  if (encoded.eFrameType == videoFrameTypeIDR) key_s = wish.stamp_s;
  append(encoded, out);
  return true;
}

H264Encoder::H264Encoder() : impl_(std::make_unique<Impl>()) {}
H264Encoder::~H264Encoder() = default;

void H264Encoder::encode(const RgbImage& image, const VideoWish& wish,
                         std::vector<std::uint8_t>& out) {
  out.clear();
  to_i420(image, impl_->picture);
  if (!impl_->prepare(wish)) return;
  // After a failure nothing later can be decoded: begin anew.
  if (!impl_->encode(wish, out)) impl_->encoder.reset();
  impl_->last = wish;
}

}  // namespace foretrack

#else

namespace foretrack {

bool has_video_encoder() {
  return false;
}

struct H264Encoder::Impl {};
H264Encoder::H264Encoder() = default;
H264Encoder::~H264Encoder() = default;
void H264Encoder::encode(const RgbImage&, const VideoWish&, std::vector<std::uint8_t>& out) {
  out.clear();
}

}  // namespace foretrack

#endif
