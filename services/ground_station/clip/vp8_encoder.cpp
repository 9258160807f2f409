// SPDX-License-Identifier: Apache-2.0
#include "services/ground_station/clip/vp8_encoder.hpp"

#include <stdexcept>
#include <string>

#ifdef FORETRACK_VPX

#include <vpx/vp8cx.h>
#include <vpx/vpx_encoder.h>

namespace foretrack::station {
namespace {

constexpr int kQuantizer = 16;  // 4 to 63: what pictures are at least as good as
constexpr unsigned kMost_kbit_s = 6000;
constexpr int kSpeed = 6;               // 0 to 16
constexpr std::int64_t kKey_ms = 2000;  // it is sought to within that

void require(bool well, const char* what) {
  if (!well) throw std::runtime_error(std::string("libvpx cannot ") + what);
}

}  // namespace

struct Vp8Encoder::Impl {
  vpx_codec_ctx_t codec{};
  std::int64_t key_ms = -kKey_ms;

  ~Impl() { vpx_codec_destroy(&codec); }
};

Vp8Encoder::Vp8Encoder(int width_px, int height_px) : impl_(std::make_unique<Impl>()) {
  vpx_codec_enc_cfg_t config;
  require(vpx_codec_enc_config_default(vpx_codec_vp8_cx(), &config, 0) == VPX_CODEC_OK, "begin");
  config.g_w = static_cast<unsigned>(width_px);
  config.g_h = static_cast<unsigned>(height_px);
  config.g_timebase = {1, 1000};
  config.g_lag_in_frames = 0;
  config.rc_end_usage = VPX_CQ;
  config.rc_target_bitrate = kMost_kbit_s;
  config.kf_mode = VPX_KF_DISABLED;  // by time, see encode()
  require(vpx_codec_enc_init(&impl_->codec, vpx_codec_vp8_cx(), &config, 0) == VPX_CODEC_OK,
          "encode pictures of this size");
  vpx_codec_control(&impl_->codec, VP8E_SET_CPUUSED, kSpeed);
  vpx_codec_control(&impl_->codec, VP8E_SET_CQ_LEVEL, static_cast<unsigned>(kQuantizer));
}

Vp8Encoder::~Vp8Encoder() = default;

Vp8Encoder::Encoded Vp8Encoder::encode(I420Image& picture, std::int64_t time_ms) {
  vpx_image_t image;
  vpx_img_wrap(&image, VPX_IMG_FMT_I420, static_cast<unsigned>(picture.width_px),
               static_cast<unsigned>(picture.height_px), 1, picture.bytes.data());
  const bool key = time_ms - impl_->key_ms >= kKey_ms;
  if (key) impl_->key_ms = time_ms;
  require(vpx_codec_encode(&impl_->codec, &image, time_ms, 1, key ? VPX_EFLAG_FORCE_KF : 0,
                           VPX_DL_REALTIME) == VPX_CODEC_OK,
          "encode a picture");
  vpx_codec_iter_t iterator = nullptr;
  const vpx_codec_cx_pkt_t* packet = vpx_codec_get_cx_data(&impl_->codec, &iterator);
  require(packet && packet->kind == VPX_CODEC_CX_FRAME_PKT, "encode a picture");
  return {{static_cast<const std::uint8_t*>(packet->data.frame.buf), packet->data.frame.sz},
          (packet->data.frame.flags & VPX_FRAME_IS_KEY) != 0};
}

}  // namespace foretrack::station

#else

namespace foretrack::station {

struct Vp8Encoder::Impl {};
Vp8Encoder::Vp8Encoder(int, int) {
  throw std::runtime_error("there are no clips: foretrack was built without libvpx");
}
Vp8Encoder::~Vp8Encoder() = default;
Vp8Encoder::Encoded Vp8Encoder::encode(I420Image&, std::int64_t) {
  return {};
}

}  // namespace foretrack::station

#endif
