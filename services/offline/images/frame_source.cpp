// SPDX-License-Identifier: Apache-2.0
#include "services/offline/images/frame_source.hpp"

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <opencv2/videoio.hpp>
#include <stdexcept>

#include "services/common/time_now.hpp"

namespace foretrack {
namespace {

namespace fs = std::filesystem;
constexpr int kMostFrameSide_px = 16384;
constexpr double kUsualRate_hz = 30.0;

RgbImage rgb_of(const cv::Mat& bgr, const std::string& name) {
  if (bgr.cols > kMostFrameSide_px || bgr.rows > kMostFrameSide_px)
    throw std::runtime_error(name + ": " + std::to_string(bgr.cols) + " × " +
                             std::to_string(bgr.rows) + " pixels; at most " +
                             std::to_string(kMostFrameSide_px) + " a side");
  RgbImage image{bgr.cols, bgr.rows, {}};
  image.rgb.resize(3 * bgr.total());
  cv::Mat rgb(bgr.rows, bgr.cols, CV_8UC3, image.rgb.data());
  cv::cvtColor(bgr, rgb, cv::COLOR_BGR2RGB);
  return image;
}

class PictureSource : public FrameSource {
 public:
  explicit PictureSource(std::vector<std::string> files) : files_(std::move(files)) {}
  std::optional<Frame> next() override {
    if (next_ == files_.size()) return std::nullopt;
    const std::string& file = files_[next_++];
    return Frame{0.0, file, load_picture(file)};
  }
  int count() const override { return static_cast<int>(files_.size()); }

 private:
  std::vector<std::string> files_;
  std::size_t next_ = 0;
};

class VideoSource : public FrameSource {
 public:
  explicit VideoSource(const std::string& file) : file_(file) {
    if (!fs::exists(file)) throw std::runtime_error(file + ": no such file");
    if (!capture_.open(file)) throw std::runtime_error(file + ": not a video that can be read");
    rate_hz_ = capture_.get(cv::CAP_PROP_FPS);
    if (!(rate_hz_ > 0.1 && rate_hz_ < 1000.0)) rate_hz_ = kUsualRate_hz;
  }
  std::optional<Frame> next() override {
    if (!capture_.read(frame_) || frame_.empty()) {
      if (read_ == 0) throw std::runtime_error(file_ + ": no frame can be read from this video");
      return std::nullopt;
    }
    return Frame{stamp_s(), "", rgb_of(frame_, file_)};
  }
  int count() const override {
    return std::max(0, static_cast<int>(capture_.get(cv::CAP_PROP_FRAME_COUNT)));
  }
  double rate_hz() const override { return rate_hz_; }

 private:
  // The frame's own: rates vary. From the rate where the file has none, or they do not increase.
  double stamp_s() {
    const double said_s = 1e-3 * capture_.get(cv::CAP_PROP_POS_MSEC);
    if (read_++ == 0) {
      first_s_ = said_s;
      return last_s_ = 0.0;
    }
    const double since_s = said_s - first_s_;
    return last_s_ = since_s > last_s_ ? since_s : last_s_ + 1.0 / rate_hz_;
  }

  std::string file_;
  cv::VideoCapture capture_;
  cv::Mat frame_;
  double rate_hz_ = 0.0;
  double first_s_ = 0.0, last_s_ = 0.0;
  int read_ = 0;
};

class CameraSource : public FrameSource {
 public:
  explicit CameraSource(const std::string& device) : device_(device) {
    const bool number =
        !device.empty() && device.size() < 4 &&
        std::all_of(device.begin(), device.end(), [](char c) { return c >= '0' && c <= '9'; });
    const bool opened = number ? capture_.open(std::stoi(device), cv::CAP_V4L2)
                               : capture_.open(device, cv::CAP_V4L2);
    if (!opened)
      throw std::runtime_error(device +
                               ": no camera can be opened there (a device such as "
                               "/dev/video0 is expected; may this user read it?)");
    capture_.set(cv::CAP_PROP_BUFFERSIZE, 1);
  }
  std::optional<Frame> next() override {
    if (!capture_.read(frame_) || frame_.empty())
      throw std::runtime_error(device_ + ": the camera gives no images any more");
    return Frame{steady_s() - opened_s_, "", rgb_of(frame_, device_)};
  }
  double rate_hz() const override { return capture_.get(cv::CAP_PROP_FPS); }

 private:
  std::string device_;
  cv::VideoCapture capture_;
  cv::Mat frame_;
  double opened_s_ = steady_s();
};

}  // namespace

std::unique_ptr<FrameSource> open_pictures(std::vector<std::string> files) {
  return std::make_unique<PictureSource>(std::move(files));
}
std::unique_ptr<FrameSource> open_video(const std::string& file) {
  return std::make_unique<VideoSource>(file);
}
std::unique_ptr<FrameSource> open_camera(const std::string& device) {
  return std::make_unique<CameraSource>(device);
}

RgbImage load_picture(const std::string& file) {
  std::error_code error;
  if (!fs::exists(file, error)) throw std::runtime_error(file + ": no such file");
  if (!fs::is_regular_file(file, error)) throw std::runtime_error(file + ": not a file");
  if (fs::file_size(file, error) == 0) throw std::runtime_error(file + ": empty");
  cv::Mat picture;
  try {
    picture = cv::imread(file, cv::IMREAD_COLOR);
  } catch (const cv::Exception& trouble) {  // e.g. more pixels than OpenCV takes
    throw std::runtime_error(
        file + ": OpenCV cannot take this picture, e.g. because of its size (" + trouble.err + ")");
  }
  if (picture.empty())
    throw std::runtime_error(file +
                             ": not a picture that can be read (damaged, or no PNG or JPEG)");
  return rgb_of(picture, file);
}

}  // namespace foretrack
