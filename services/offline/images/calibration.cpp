// SPDX-License-Identifier: Apache-2.0
#include "services/offline/images/calibration.hpp"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

#include "services/files/yaml/yaml_reader.hpp"

namespace foretrack {
namespace {

constexpr double kMostSide_px = 16384.0;

/// What camera_calibration calls things, or CameraInfo.
struct Keys {
  const char *width, *height, *matrix, *coefficients;
};
constexpr Keys kFileKeys = {"image_width", "image_height", "camera_matrix",
                            "distortion_coefficients"};
constexpr Keys kMessageKeys = {"width", "height", "k", "d"};

struct Reader {
  const YAML::Node& document;
  Faults& faults;

  void fault(const char* key, const std::string& text) const {
    const YAML::Node node = document[key];
    faults.add((node ? node : document).Mark(), text);
  }
  // A missing or malformed number is a fault, and 0.
  int side(const char* key) const {
    const YAML::Node node = document[key];
    double value = 0.0;
    if (!node || !node.IsScalar() || !YAML::convert<double>::decode(node, value) ||
        !(value >= 1.0 && value <= kMostSide_px) || value != std::floor(value)) {
      fault(key, fmt::format("{}: a whole number from 1 to {:g} expected", key, kMostSide_px));
      return 0;
    }
    return static_cast<int>(value);
  }
  // {rows, cols, data: [...]}, or the list alone; `count` 0: any. None: a fault.
  std::optional<std::vector<double>> numbers(const char* key, std::size_t count) const {
    const YAML::Node node = document[key];
    const YAML::Node data = node && node.IsMap() ? node["data"] : node;
    std::vector<double> values;
    bool good = data && data.IsSequence() && (count == 0 || data.size() == count);
    for (std::size_t k = 0; good && k < data.size(); ++k) {
      double value = 0.0;
      good = data[k].IsScalar() && YAML::convert<double>::decode(data[k], value) &&
             std::isfinite(value);
      values.push_back(value);
    }
    if (good) return values;
    fault(key, fmt::format("{}: a list of {}{}numbers expected", key,
                           count ? std::to_string(count) : "", count ? " " : ""));
    return std::nullopt;
  }
};

std::optional<CameraModel> read_camera(const Reader& reader, const Keys& keys) {
  const int width_px = reader.side(keys.width), height_px = reader.side(keys.height);
  const auto values = reader.numbers(keys.matrix, 9);
  if (width_px == 0 || height_px == 0 || !values) return std::nullopt;
  std::array<double, 9> matrix{};
  std::copy(values->begin(), values->end(), matrix.begin());
  const auto faults = faults_of_matrix(width_px, height_px, matrix);
  for (const auto& fault : faults)
    reader.fault(keys.matrix, fmt::format("{}: {}", keys.matrix, fault));
  if (!faults.empty()) return std::nullopt;
  return camera_of_matrix(width_px, height_px, matrix);
}

std::optional<Lens> read_lens(const Reader& reader, const Keys& keys) {
  std::vector<double> coefficients;
  if (const YAML::Node node = reader.document[keys.coefficients]; node && !node.IsNull()) {
    const auto values = reader.numbers(keys.coefficients, 0);
    if (!values) return std::nullopt;
    coefficients = *values;
  }
  const YAML::Node model = reader.document["distortion_model"];
  try {
    return lens_of(model && model.IsScalar() ? model.Scalar() : "", coefficients);
  } catch (const std::invalid_argument& error) {
    reader.fault(keys.coefficients, error.what());
    return std::nullopt;
  }
}

}  // namespace

CameraWithLens load_calibration(const std::string& file) {
  Faults faults(file);
  const YAML::Node document = load_yaml(file);
  if (!document.IsMap()) {
    faults.add(document.Mark(), "a camera calibration expected (image_width, camera_matrix, ...)");
    faults.throw_if_any();
  }
  const Reader reader{document, faults};
  const Keys& keys = document["k"] && !document["camera_matrix"] ? kMessageKeys : kFileKeys;
  const auto camera = read_camera(reader, keys);
  const auto lens = read_lens(reader, keys);
  faults.throw_if_any();
  const CameraWithLens result{*camera, *lens};
  if (const std::string fault = fault_of(result); !fault.empty())
    reader.fault(keys.matrix, fmt::format("{}: {}", keys.matrix, fault));
  faults.throw_if_any();
  return result;
}

std::string describe(const CameraWithLens& c) {
  return fmt::format("{} × {} px, {:.0f}° × {:.0f}° of view", c.camera.width_px, c.camera.height_px,
                     deg(c.horizontal_view_rad()), deg(c.vertical_view_rad()));
}

}  // namespace foretrack
