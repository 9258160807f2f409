// SPDX-License-Identifier: Apache-2.0
#include "services/offline/images/calibration.hpp"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

#include "services/files/yaml/yaml_reader.hpp"

namespace foretrack {
namespace {

constexpr double kMostSide_px = 16384.0;
constexpr double kMostFocal_px = 1e5;

struct Reader {
  const YAML::Node& document;
  Faults& faults;

  // A missing or malformed number is a fault, and 0.
  double number(const char* key, double max) const {
    const YAML::Node node = document[key];
    double value = 0.0;
    if (!node || !node.IsScalar() || !YAML::convert<double>::decode(node, value) ||
        !(value >= 1.0 && value <= max))
      faults.add((node ? node : document).Mark(),
                 fmt::format("{}: a number from 1 to {:g} expected", key, max));
    return value;
  }
  // {rows, cols, data: [...]}; `count` 0: any.
  std::vector<double> matrix(const char* key, std::size_t count) const {
    const YAML::Node node = document[key];
    const YAML::Node data = node && node.IsMap() ? node["data"] : YAML::Node();
    std::vector<double> values;
    bool good = data && data.IsSequence() && (count == 0 || data.size() == count);
    for (std::size_t k = 0; good && k < data.size(); ++k) {
      double value = 0.0;
      good = data[k].IsScalar() && YAML::convert<double>::decode(data[k], value) &&
             std::isfinite(value);
      values.push_back(value);
    }
    if (good) return values;
    faults.add((node ? node : document).Mark(), fmt::format("{}.data: {} numbers expected", key,
                                                            count ? std::to_string(count) : ""));
    return {};
  }
};

void read_camera(const Reader& reader, CameraModel& camera) {
  camera.width_px = static_cast<int>(reader.number("image_width", kMostSide_px));
  camera.height_px = static_cast<int>(reader.number("image_height", kMostSide_px));
  const auto k = reader.matrix("camera_matrix", 9);
  if (k.empty()) return;
  if (!(k[0] > 0.0 && k[4] > 0.0 && k[0] < kMostFocal_px && k[4] < kMostFocal_px) ||
      std::abs(k[2]) > kMostFocal_px || std::abs(k[5]) > kMostFocal_px)
    return reader.faults.add(
        reader.document["camera_matrix"].Mark(),
        "camera_matrix.data: fx, 0, cx, 0, fy, cy, 0, 0, 1 in pixels expected");
  camera.fx_px = k[0];
  camera.cx_px = k[2];
  camera.fy_px = k[4];
  camera.cy_px = k[5];
}

}  // namespace

Calibration load_calibration(const std::string& file) {
  Faults faults(file);
  const YAML::Node document = load_yaml(file);
  Calibration calibration;
  if (!document.IsMap()) {
    faults.add(document.Mark(), "a camera calibration expected (image_width, camera_matrix, ...)");
    faults.throw_if_any();
  }
  const Reader reader{document, faults};
  read_camera(reader, calibration.camera);
  try {
    const YAML::Node model = document["distortion_model"];
    const bool distorted = static_cast<bool>(document["distortion_coefficients"]);
    calibration.lens =
        lens_of(model && model.IsScalar() ? model.Scalar() : "",
                distorted ? reader.matrix("distortion_coefficients", 0) : std::vector<double>());
  } catch (const std::invalid_argument& error) {
    faults.add(document["distortion_coefficients"] ? document["distortion_coefficients"].Mark()
                                                   : document.Mark(),
               error.what());
  }
  faults.throw_if_any();
  return calibration;
}

}  // namespace foretrack
