// SPDX-License-Identifier: Apache-2.0
#include "services/offline/images/frame_sink.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <opencv2/videoio.hpp>
#include <stdexcept>
#include <utility>

namespace foretrack {
namespace {

constexpr std::array<std::pair<int, int>, 35> kBones = {
    {{0, 1},   {1, 2},   {2, 3},   {3, 7},   {0, 4},   {4, 5},   {5, 6},   {6, 8},   {9, 10},
     {11, 12}, {11, 13}, {13, 15}, {15, 17}, {15, 19}, {15, 21}, {17, 19}, {12, 14}, {14, 16},
     {16, 18}, {16, 20}, {16, 22}, {18, 20}, {11, 23}, {12, 24}, {23, 24}, {23, 25}, {24, 26},
     {25, 27}, {26, 28}, {27, 29}, {28, 30}, {29, 31}, {30, 32}, {27, 31}, {28, 32}}};
constexpr double kVisible = 0.5;
constexpr int kFraction = 4;  // bits of a pixel, so that lines do not jitter
const cv::Scalar kLeft(255, 138, 0), kRight(0, 170, 255), kMiddle(240, 240, 240), kDark(30, 30, 30);

// Landmarks with odd numbers from 11 on are on the left, with even ones on the right.
cv::Scalar colour_of(int a, int b) {
  if (a < 11 || (a + b) % 2 != 0) return kMiddle;
  return a % 2 == 1 ? kLeft : kRight;
}

cv::Point fixed(const Vec2& px) {
  const Vec2 scaled = (px * (1 << kFraction)).cwiseMax(-1e7).cwiseMin(1e7);
  return {static_cast<int>(std::lround(scaled.x())), static_cast<int>(std::lround(scaled.y()))};
}

std::string ending_of(const std::string& file) {
  std::string ending = std::filesystem::path(file).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return ending;
}

cv::Mat bgr_of(const RgbImage& image) {
  cv::Mat bgr;
  const cv::Mat rgb(image.height_px, image.width_px, CV_8UC3,
                    const_cast<std::uint8_t*>(image.rgb.data()));
  cv::cvtColor(rgb, bgr, cv::COLOR_RGB2BGR);
  return bgr;
}

class PictureSink : public FrameSink {
 public:
  explicit PictureSink(std::string file) : file_(std::move(file)) {}
  void write(const RgbImage& image) override {
    if (!cv::imwrite(file_, bgr_of(image))) throw std::runtime_error(file_ + ": cannot be written");
  }

 private:
  std::string file_;
};

class VideoSink : public FrameSink {
 public:
  VideoSink(std::string file, double rate_hz) : file_(std::move(file)), rate_hz_(rate_hz) {}
  void write(const RgbImage& image) override {
    const cv::Mat bgr = bgr_of(image);
    if (!writer_.isOpened()) open(bgr.size());
    writer_.write(bgr);
  }

 private:
  void open(const cv::Size& size) {
    const bool avi = ending_of(file_) == ".avi";
    const int codec = avi ? cv::VideoWriter::fourcc('M', 'J', 'P', 'G')
                          : cv::VideoWriter::fourcc('m', 'p', '4', 'v');
    if (!writer_.open(file_, codec, rate_hz_, size))
      throw std::runtime_error(file_ + ": this video cannot be written");
  }

  std::string file_;
  double rate_hz_;
  cv::VideoWriter writer_;
};

}  // namespace

void draw_person(RgbImage& image, const PersonPose& person, const std::string& text) {
  cv::Mat canvas(image.height_px, image.width_px, CV_8UC3, image.rgb.data());
  const double unit = std::clamp(person.region.size_px / 400.0, 0.6, 4.0);
  const int thick = std::max(1, static_cast<int>(std::lround(2.0 * unit)));
  const auto seen = [&](int k) { return person.landmarks[k].visibility > kVisible; };
  const auto place = [&](int k) { return fixed(person.landmarks[k].image_px); };
  for (const auto& [a, b] : kBones)
    if (seen(a) && seen(b))
      cv::line(canvas, place(a), place(b), colour_of(a, b), thick, cv::LINE_AA, kFraction);
  for (int k = 0; k < kLandmarkCount; ++k)
    if (seen(k))
      cv::circle(canvas, place(k), static_cast<int>(std::lround(2.4 * unit * (1 << kFraction))),
                 k < 11 ? kMiddle : colour_of(k, k), cv::FILLED, cv::LINE_AA, kFraction);
  if (text.empty()) return;
  Vec2 lowest = person.landmarks[0].image_px, least = lowest;
  for (int k = 0; k < kLandmarkCount; ++k)
    if (seen(k)) {
      lowest = lowest.cwiseMax(person.landmarks[k].image_px);
      least = least.cwiseMin(person.landmarks[k].image_px);
    }
  int below = 0;
  const cv::Size size = cv::getTextSize(text, cv::FONT_HERSHEY_SIMPLEX, 0.45, 1, &below);
  const int x =
      std::clamp(static_cast<int>(least.x()), 4, std::max(4, image.width_px - size.width - 4));
  const int y =
      std::clamp(static_cast<int>(lowest.y()) + 18, 16, std::max(16, image.height_px - 8));
  cv::rectangle(canvas, {x - 3, y - size.height - 4}, {x + size.width + 3, y + below + 1}, kDark,
                cv::FILLED);
  cv::putText(canvas, text, {x, y}, cv::FONT_HERSHEY_SIMPLEX, 0.45, kMiddle, 1, cv::LINE_AA);
}

bool is_video_name(const std::string& file) {
  const std::string ending = ending_of(file);
  return ending == ".mp4" || ending == ".avi" || ending == ".mkv";
}

std::unique_ptr<FrameSink> open_sink(const std::string& file, double rate_hz) {
  if (is_video_name(file)) return std::make_unique<VideoSink>(file, rate_hz > 1.0 ? rate_hz : 30.0);
  const std::string ending = ending_of(file);
  if (ending != ".png" && ending != ".jpg" && ending != ".jpeg")
    throw std::invalid_argument(file + ": .png, .jpg, .mp4, .avi or .mkv expected");
  return std::make_unique<PictureSink>(file);
}

}  // namespace foretrack
