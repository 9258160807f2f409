// SPDX-License-Identifier: Apache-2.0
#include "core/perception/detect_people.hpp"

#include <algorithm>
#include <cmath>

#include "core/perception/sample_image.hpp"

namespace foretrack {
namespace {

constexpr int kDetectorSide = 224;
constexpr int kAnchorNumbers = 12;  // of an anchor: box centre and size, four points
constexpr double kMostLogit = 100.0;
constexpr double kSamePerson = 0.3;  // intersection over union
constexpr double kMargin = 1.25;     // of the region around the body

struct Grid {
  int cells;     // a side
  int per_cell;  // anchors
};
constexpr std::array<Grid, 3> kGrids = {{{28, 2}, {14, 2}, {7, 6}}};  // strides 8, 16, 32

double overlap(const Detection& a, const Detection& b) {
  const Vec2 low = a.box_min_px.cwiseMax(b.box_min_px), high = a.box_max_px.cwiseMin(b.box_max_px);
  const Vec2 common = (high - low).cwiseMax(0.0);
  const double shared = common.prod();
  const double both =
      (a.box_max_px - a.box_min_px).prod() + (b.box_max_px - b.box_min_px).prod() - shared;
  return both > 0.0 ? shared / both : 0.0;
}

// Numbers are in pixels of the network's input, around the anchor.
Detection decode(const float* numbers, const Vec2& anchor, double score,
                 const ImageRegion& window) {
  const auto pair = [&](int k) -> Vec2 { return Vec2(numbers[k], numbers[k + 1]) / kDetectorSide; };
  Detection d;
  d.score = score;
  // In a turned window the box in the image is around its four corners.
  const Vec2 middle = anchor + pair(0), half = 0.5 * pair(2).cwiseMax(0.0);
  d.box_min_px = d.box_max_px = window.image_px(middle - half);
  for (const Vec2& side : {Vec2(1.0, 1.0), Vec2(1.0, -1.0), Vec2(-1.0, 1.0)}) {
    const Vec2 corner = window.image_px(middle + side.cwiseProduct(half));
    d.box_min_px = d.box_min_px.cwiseMin(corner);
    d.box_max_px = d.box_max_px.cwiseMax(corner);
  }
  for (int k = 0; k < 4; ++k) d.points_px[k] = window.image_px(anchor + pair(4 + 2 * k));
  return d;
}

bool is_finite(const Detection& d) {
  bool finite = d.box_min_px.allFinite() && d.box_max_px.allFinite();
  for (const Vec2& point : d.points_px) finite = finite && point.allFinite();
  return finite;
}

std::vector<Detection> decode_all(std::span<const float> numbers, std::span<const float> logits,
                                  const ImageRegion& window, double min_score) {
  std::vector<Detection> found;
  std::size_t k = 0;
  for (const Grid& grid : kGrids)
    for (int cell = 0; cell < grid.cells * grid.cells; ++cell) {
      const int row = cell / grid.cells, column = cell % grid.cells;
      const Vec2 anchor((column + 0.5) / grid.cells, (row + 0.5) / grid.cells);
      for (int n = 0; n < grid.per_cell; ++n, ++k) {
        const double logit = std::clamp<double>(logits[k], -kMostLogit, kMostLogit);
        const double score = 1.0 / (1.0 + std::exp(-logit));
        if (!(score >= min_score)) continue;
        const Detection d = decode(&numbers[k * kAnchorNumbers], anchor, score, window);
        if (is_finite(d)) found.push_back(d);
      }
    }
  return found;
}

// Of those that overlap the first: their mean by score.
Detection average(const std::vector<Detection>& group) {
  Detection mean = group.front();
  double total = 0.0;
  mean.box_min_px = mean.box_max_px = Vec2::Zero();
  mean.points_px.fill(Vec2::Zero());
  for (const Detection& d : group) {
    total += d.score;
    mean.box_min_px += d.score * d.box_min_px;
    mean.box_max_px += d.score * d.box_max_px;
    for (int k = 0; k < 4; ++k) mean.points_px[k] += d.score * d.points_px[k];
  }
  mean.box_min_px /= total;
  mean.box_max_px /= total;
  for (Vec2& point : mean.points_px) point /= total;
  return mean;
}

std::vector<Detection> suppress(std::vector<Detection> found) {
  std::stable_sort(found.begin(), found.end(),
                   [](const auto& a, const auto& b) { return a.score > b.score; });
  std::vector<Detection> people, group;
  while (!found.empty()) {
    const Detection first = found.front();
    group.clear();
    std::erase_if(found, [&](const Detection& d) {
      const bool same = overlap(first, d) > kSamePerson;
      if (same) group.push_back(d);
      return same;
    });
    if (group.empty()) {  // a box without area
      found.erase(found.begin());
      continue;
    }
    people.push_back(average(group));
  }
  return people;
}

}  // namespace

std::vector<Detection> detect_people(const RgbImage& image, const ImageRegion& window,
                                     Inference& detector, double min_score) {
  sample_region(image, window, Border::kBlack, kDetectorSide, 2.0f, -1.0f, detector.input());
  detector.run();
  return suppress(decode_all(detector.output(0), detector.output(1), window, min_score));
}

ImageRegion whole_of(const RgbImage& image) {
  const double side_px = std::max(image.width_px, image.height_px);
  return {{0.5 * image.width_px, 0.5 * image.height_px}, side_px, 0.0};
}

ImageRegion region_of_body(const Vec2& middle_px, const Vec2& end_px) {
  const Vec2 up = end_px - middle_px;
  ImageRegion region;
  region.centre_px = middle_px;
  region.size_px = 2.0 * kMargin * up.norm();
  region.angle_rad = wrap_angle(std::atan2(up.x(), -up.y()));
  return region;
}

ImageRegion region_of_body(const Detection& person) {
  return region_of_body(person.points_px[0], person.points_px[1]);
}

}  // namespace foretrack
