// SPDX-License-Identifier: Apache-2.0
#include "core/planning/search/viewpoint.hpp"

#include <algorithm>
#include <cmath>

namespace foretrack {
namespace {

constexpr double kForesightStep_s = 0.25;
constexpr int kViewBins = 24;             // of directions
constexpr double kAsideShare = 0.25;      // that belief beside the angle of view counts
constexpr double kOutOfReachShare = 0.4;  // that who is seen out of reach counts
constexpr int kNearBearings = 12;

}  // namespace

void foresee(const PersonCloud& cloud, const SearchGround& ground, CloudFuture& future) {
  Random random(7);
  double sum = 0.0;
  for (int i = 0; i < CloudFuture::kWalkers; ++i) {
    Walker w = cloud.walkers[4 * i];
    future.weight[i] = w.weight;
    sum += w.weight;
    double now_s = 0.0;
    for (std::size_t k = 0; k < CloudFuture::kMoments_s.size(); ++k) {
      for (; now_s < CloudFuture::kMoments_s[k] - 1e-9; now_s += kForesightStep_s)
        walk_on(w, cloud, ground, std::min(kForesightStep_s, CloudFuture::kMoments_s[k] - now_s),
                random);
      future.at_m[i][k] = w.at_m;
    }
  }
  for (double& weight : future.weight) weight /= std::max(sum, 1e-12);
}

Viewpoint judge_viewpoint(const CloudFuture& future, const SearchGround& ground,
                          const DistanceField& reach, const Vec2& at, double arrival_s,
                          double view_angle_rad, const SearchParams& params) {
  std::array<double, kViewBins> bins{};
  double all = 0.0;
  for (int i = 0; i < CloudFuture::kWalkers; ++i)
    for (std::size_t k = 0; k < CloudFuture::kMoments_s.size(); ++k) {
      const Vec2 span = future.at_m[i][k] - at;
      const double time_s = std::max(CloudFuture::kMoments_s[k], arrival_s);
      // Who walks past before the vehicle is there is not seen.
      if (CloudFuture::kMoments_s[k] < arrival_s && k + 1 < CloudFuture::kMoments_s.size())
        continue;
      if (span.norm() > params.search_sight_m || !is_in_sight(ground, at, future.at_m[i][k]))
        continue;
      const bool within_reach =
          reach.steps[ground.cell_of(future.at_m[i][k])] != DistanceField::kNever;
      const double gain = (within_reach ? 1.0 : kOutOfReachShare) * future.weight[i] *
                          std::exp(-time_s / params.search_patience_s);
      const int bin = static_cast<int>((yaw_of(span) + kPi) / (2.0 * kPi) * kViewBins);
      bins[std::clamp(bin, 0, kViewBins - 1)] += gain;
      all += gain;
      break;
    }
  Viewpoint view{at, 0.0, -1.0};
  const int width = std::max(1, static_cast<int>(view_angle_rad / (2.0 * kPi) * kViewBins));
  for (int first = 0; first < kViewBins; ++first) {
    double seen = 0.0;
    for (int i = 0; i < width; ++i) seen += bins[(first + i) % kViewBins];
    const double worth = seen + kAsideShare * (all - seen);
    if (worth <= view.worth) continue;
    view.worth = worth;
    view.gaze_rad = wrap_angle((first + 0.5 * width) * 2.0 * kPi / kViewBins - kPi);
  }
  return view;
}

bool may_be_near(const SearchGround& ground, const Vec2& at, double reach_m) {
  for (int i = 0; i < kNearBearings; ++i)
    for (const double share : {0.35, 0.7, 1.0}) {
      const Vec2 there = at + share * reach_m * direction_of(2.0 * kPi * i / kNearBearings);
      const int cell = ground.cell_of(there);
      if (cell >= 0 && ground.may_be[cell] != 0 && is_in_sight(ground, at, there)) return true;
    }
  return false;
}

}  // namespace foretrack
