// SPDX-License-Identifier: Apache-2.0
#include "core/perception/watch_others.hpp"

#include <limits>
#include <utility>

#include "core/perception/detect_people.hpp"

namespace foretrack {
namespace {

// Lengths in sizes of the chosen person's region.
constexpr double kAround = 2.0;  // side of what is looked at
constexpr double kAside = 0.75;  // its middle, to the left and to the right in turns
constexpr double kFar = 1.5;     // nobody to care for
constexpr double kSame = 0.1;    // nearer, it is the same person
constexpr double kSameDetected = 0.15;
constexpr double kApart = 0.45;  // farther, nothing of the one is taken for the other
constexpr double kForgotten_s = 1.5;

bool is_near(const PoseState& state, const Vec2& torso_px, double ratio) {
  return (torso_px - state.place.px).norm() < ratio * state.chosen.size_px;
}

void keep_eye_on_other(PoseState& state, const RgbImage& image, double stamp_s,
                       PoseNetwork& network, const PerceptionParams& params,
                       std::vector<OtherPerson>& seen_now) {
  PersonMemory& other = state.other;
  const TorsoPlace place = place_at(other, stamp_s);
  if (stamp_s - other.seen_s > kForgotten_s || !is_near(state, place.px, kFar)) {
    other = {};
    return;
  }
  ImageRegion region = *other.region;
  region.centre_px += place.px - other.torso_px;
  const auto pose = find_landmarks(image, region, *network.landmarks, params.min_pose_score);
  if (!pose) return;
  const auto seen = appearance_of(image, *pose);
  const double theirs = unlikeness(other, place, stamp_s, *pose, seen);
  if (theirs > unlikeness(state.chosen, state.place, stamp_s, *pose, seen)) return;
  if ((pose->torso_px() - place.px).norm() > params.jump_ratio * other.size_px) return;
  remember(other, *pose, seen, stamp_s, !is_near(state, place.px, kApart));
  seen_now.push_back({pose->region, *pose, seen});
}

bool is_other(const PoseState& state, const Vec2& torso_px, double stamp_s) {
  const double apart_px = (torso_px - place_at(state.other, stamp_s).px).norm();
  return state.other.known() && apart_px < kSameDetected * state.other.size_px;
}

// The nearest one who is neither the chosen person nor the other one.
const Detection* nearest_new(const PoseState& state, const std::vector<Detection>& people,
                             double stamp_s) {
  const Detection* nearest = nullptr;
  double least = kFar * state.chosen.size_px;
  const Vec2 other_px = place_at(state.other, stamp_s).px;
  if (state.other.known()) least = std::min(least, (other_px - state.place.px).norm());
  for (const Detection& person : people) {
    const double distance = (person.torso_px() - state.place.px).norm();
    if (distance >= least || is_near(state, person.torso_px(), kSameDetected)) continue;
    if (is_other(state, person.torso_px(), stamp_s)) continue;
    least = distance, nearest = &person;
  }
  return nearest;
}

void look_around(PoseState& state, const RgbImage& image, double stamp_s, PoseNetwork& network,
                 const PerceptionParams& params, std::vector<OtherPerson>& seen_now) {
  state.watched_s = stamp_s;
  const ImageRegion whole = whole_of(image);
  const double side_px = kAround * state.chosen.size_px;
  const double aside_px = (state.watches++ % 2 ? kAside : -kAside) * state.chosen.size_px;
  const ImageRegion window = side_px < whole.size_px
                                 ? ImageRegion{state.place.px + Vec2(aside_px, 0.0), side_px, 0.0}
                                 : whole;
  const auto people = detect_people(image, window, *network.detector, params.min_detection_score);
  const Detection* person = nearest_new(state, people, stamp_s);
  for (const Detection& d : people)
    if (&d != person && !is_near(state, d.torso_px(), kSameDetected) &&
        !is_other(state, d.torso_px(), stamp_s))
      seen_now.push_back({region_of_body(d), std::nullopt, std::nullopt});
  if (!person) return;
  const auto pose =
      find_landmarks(image, region_of_body(*person), *network.landmarks, params.min_pose_score);
  if (!pose || is_near(state, pose->torso_px(), kSame)) return;
  state.other = {};
  const auto wears = appearance_of(image, *pose);
  remember(state.other, *pose, wears, stamp_s, true);
  seen_now.push_back({pose->region, *pose, wears});
}

}  // namespace

std::vector<OtherPerson> watch_others(PoseState& state, const RgbImage& image, double stamp_s,
                                      PoseNetwork& network, const PerceptionParams& params) {
  std::vector<OtherPerson> others = std::exchange(state.passed_over, {});
  if (!state.chosen.known() || !is_picture(image)) return others;
  if (state.other.known()) keep_eye_on_other(state, image, stamp_s, network, params, others);
  const bool seen_now = state.chosen.seen_s == stamp_s;
  if (seen_now && stamp_s - state.watched_s >= params.watch_period_s)
    look_around(state, image, stamp_s, network, params, others);
  return others;
}

}  // namespace foretrack
