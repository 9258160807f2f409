// SPDX-License-Identifier: Apache-2.0
#include "services/convert/encode_jpeg.hpp"

// jpeglib.h needs it before itself.
#include <jpeglib.h>

#include <algorithm>
#include <csetjmp>
#include <cstdio>
#include <cstdlib>

namespace foretrack {
namespace {

// libjpeg leaves by longjmp: no object with a destructor may live between setjmp and its calls.
struct EncoderErrors : jpeg_error_mgr {
  std::jmp_buf leave;
};
void leave_encoder(j_common_ptr encoder) {
  std::longjmp(static_cast<EncoderErrors*>(encoder->err)->leave, 1);
}
void keep_quiet(j_common_ptr) {}

struct Encoded {
  unsigned char* bytes = nullptr;
  unsigned long size = 0;
};

bool encode(const RgbImage& image, int quality, Encoded& out) {
  jpeg_compress_struct encoder{};
  EncoderErrors errors{};
  encoder.err = jpeg_std_error(&errors);
  errors.error_exit = leave_encoder;
  errors.output_message = keep_quiet;
  if (setjmp(errors.leave) != 0) {
    jpeg_destroy_compress(&encoder);
    return false;
  }
  jpeg_create_compress(&encoder);
  jpeg_mem_dest(&encoder, &out.bytes, &out.size);
  encoder.image_width = static_cast<JDIMENSION>(image.width_px);
  encoder.image_height = static_cast<JDIMENSION>(image.height_px);
  encoder.input_components = 3;
  encoder.in_color_space = JCS_RGB;
  jpeg_set_defaults(&encoder);
  jpeg_set_quality(&encoder, std::clamp(quality, 1, 100), TRUE);
  jpeg_start_compress(&encoder, TRUE);
  while (encoder.next_scanline < encoder.image_height) {
    auto* row = const_cast<JSAMPROW>(image.pixel(0, static_cast<int>(encoder.next_scanline)));
    jpeg_write_scanlines(&encoder, &row, 1);
  }
  jpeg_finish_compress(&encoder);
  jpeg_destroy_compress(&encoder);
  return true;
}

}  // namespace

void encode_jpeg(const RgbImage& image, int quality, std::vector<std::uint8_t>& out) {
  Encoded encoded;
  out.clear();
  if (encode(image, quality, encoded)) out.assign(encoded.bytes, encoded.bytes + encoded.size);
  std::free(encoded.bytes);
}

}  // namespace foretrack
