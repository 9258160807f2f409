// SPDX-License-Identifier: Apache-2.0
#include "core/perception/perceive_image.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "core/perception/detect_people.hpp"

namespace foretrack {
namespace {

constexpr int kMostSide_px = 16384;
constexpr double kClearly = 9.0;          // so much more unlike the other one, nobody doubts
constexpr double kSurprising = 3.5;       // standard deviations in one image: it is said
constexpr std::size_t kMostTried = 2;     // of the people whom the detector saw
constexpr std::size_t kMostCompared = 4;  // the same, where nobody knows where the person is
constexpr double kSurely = 0.2;     // where nobody knows where the person is, it is surely them
constexpr double kDescribed = 0.5;  // clothes that differ more are not of the described colour
constexpr double kTellApart = 0.2;  // by so much another one's clothes must differ more

// Where the chosen person may be; none: anybody may be chosen.
std::optional<ExpectedPlace> place_of_chosen(const PersonMemory& chosen, double stamp_s,
                                             const PerceptionParams& params,
                                             const std::optional<ExpectedPlace>& expected) {
  if (expected) return expected;
  const double age_s = stamp_s - chosen.seen_s;
  if (age_s > params.choice_memory_s) return std::nullopt;
  return ExpectedPlace{chosen.torso_px, chosen.size_px * params.choice_gate_ratio * (1.0 + age_s),
                       chosen.size_px / kRegionOverBody};
}

// The filter's place is where the torso is; how the pose wavers about it comes on top.
TorsoPlace torso_place(const PersonMemory& chosen, double stamp_s,
                       const std::optional<ExpectedPlace>& expected) {
  if (!expected) return place_at(chosen, stamp_s);
  const double waver_px = place_at(chosen, chosen.seen_s).sigma_px;
  return {expected->torso_px, std::hypot(waver_px, expected->sigma_px)};
}

struct Judgement {
  bool theirs = false;    // the chosen person's
  bool doubtful = false;  // it could be the other one's
  bool near = false;      // the other one is near
  bool changed = false;   // too suddenly for somebody who is found again
  double unlike = 0.0;    // the chosen person
  double difference = 0.0;
  std::optional<Appearance> seen;
};

// Whose pose is it?
Judgement judge(const PoseState& state, const RgbImage& image, const PersonPose& pose,
                double stamp_s, const PerceptionParams& params) {
  const PersonMemory &chosen = state.chosen, &other = state.other;
  Judgement j;
  j.seen = appearance_of(image, pose);
  if (!chosen.known()) {
    if (j.seen && chosen.wears) j.difference = lasting_difference(*j.seen, *chosen.wears);
    j.doubtful = j.difference > kSurely;
    j.theirs = !j.doubtful;
    j.unlike = j.difference;
    return j;
  }
  if (j.seen && chosen.wears) j.difference = difference(*j.seen, *chosen.wears);
  j.unlike = unlikeness(chosen, state.place, stamp_s, pose, j.seen);
  const auto within = [&](double gate) { return j.unlike <= gate * gate; };
  j.theirs = j.difference <= params.clothes_gate;
  j.changed = !within(params.change_gate);
  j.doubtful = !j.theirs || !within(kSurprising);
  if (!other.known()) return j;
  const TorsoPlace others = place_at(other, stamp_s);
  const double clearly = unlikeness(other, others, stamp_s, pose, j.seen) - j.unlike;
  const double apart_px = (others.px - state.place.px).norm();
  j.near = apart_px < params.doubt_ratio * kRegionOverBody * chosen.size_px;
  j.doubtful = j.doubtful || (j.near && clearly < kClearly);
  j.theirs = j.theirs && clearly > 0.0 && (!j.near || within(params.doubt_gate));
  return j;
}

void begin_anew(PoseState& state) {
  PoseState fresh;
  fresh.first = state.first;
  fresh.first_rgb = state.first_rgb;
  fresh.follows = state.follows;
  state = std::move(fresh);
}

void take(PoseState& state, const PersonPose& pose, const Judgement& j, double stamp_s,
          bool doubtful) {
  if (!state.chosen.known()) state.chosen.wears.reset();
  remember(state.chosen, pose, j.seen, stamp_s, !j.near && !doubtful);
  state.place = place_at(state.chosen, stamp_s);
  state.looks = 0;
}

// Where they are is not known any more; what they wear is.
void forget(PoseState& state) {
  const auto wore = state.chosen.wears;
  state.chosen = state.other = {};
  state.chosen.wears = wore;
}

// Those within the gate, the nearest first; without a place all, as state.first says.
std::vector<Detection> possible(std::vector<Detection> people,
                                const std::optional<ExpectedPlace>& place, FirstChoice first,
                                const RgbImage& image) {
  const auto distance_to = [](const Vec2& px) {
    return [px](const Detection& d) { return (d.torso_px() - px).norm(); };
  };
  const auto size = [](const Detection& d) { return -region_of_body(d).size_px; };
  if (place) {
    const auto distance = distance_to(place->torso_px);
    std::erase_if(people, [&](const Detection& d) { return distance(d) > place->gate_px; });
    std::ranges::stable_sort(people, {}, distance);
  } else if (first == FirstChoice::kNearest) {
    std::ranges::stable_sort(people, {}, size);
  } else if (first == FirstChoice::kMiddle) {
    std::ranges::stable_sort(people, {}, distance_to(0.5 * Vec2(image.width_px, image.height_px)));
  }
  return people;
}

/// Somebody whom the detector saw, and what the network made of them.
struct Candidate {
  ImageRegion region;
  std::optional<PersonPose> pose;
  Judgement judgement;
};

// The least unlike one who may be theirs. Without a place clothes alone tell: then another one may
// not be nearly as like.
const Candidate* choose_candidate(const std::vector<Candidate>& candidates, bool by_clothes) {
  const Candidate* best = nullptr;
  double second = std::numeric_limits<double>::infinity();
  for (const Candidate& c : candidates) {
    if (!c.pose || !c.judgement.theirs || c.judgement.changed) continue;
    if (best && best->judgement.unlike <= c.judgement.unlike) {
      second = std::min(second, c.judgement.unlike);
      continue;
    }
    if (best) second = best->judgement.unlike;
    best = &c;
  }
  const bool alike = by_clothes && best && second < best->judgement.unlike + kTellApart;
  return alike ? nullptr : best;
}

// Whose torso is nearest to the described colour.
const Candidate* described(const std::vector<Candidate>& candidates, const Vec3& rgb) {
  const Candidate* best = nullptr;
  double least = kDescribed;
  for (const Candidate& c : candidates) {
    if (!c.pose || !c.judgement.seen) continue;
    const double differs = difference_from_color(*c.judgement.seen, rgb);
    if (differs < least) least = differs, best = &c;
  }
  return best;
}

// Nobody was chosen yet, or it is who was.
const Candidate* choose_candidate(const PoseState& state, const std::vector<Candidate>& candidates,
                                  bool anywhere) {
  if (!state.follows) return nullptr;
  const bool first = anywhere && !state.chosen.wears;
  if (first && state.first == FirstChoice::kColor) return described(candidates, state.first_rgb);
  return choose_candidate(candidates, anywhere && state.chosen.wears);
}

std::vector<Candidate> look_at_people(const PoseState& state, const RgbImage& image, double stamp_s,
                                      PoseNetwork& network, const PerceptionParams& params,
                                      const std::vector<Detection>& people, std::size_t most) {
  std::vector<Candidate> candidates;
  for (const Detection& person : people) {
    Candidate& c = candidates.emplace_back(Candidate{region_of_body(person), {}, {}});
    if (candidates.size() > most) continue;
    c.pose = find_landmarks(image, c.region, *network.landmarks, params.min_pose_score);
    if (c.pose) c.judgement = judge(state, image, *c.pose, stamp_s, params);
  }
  return candidates;
}

void search(PoseState& state, const RgbImage& image, double stamp_s, PoseNetwork& network,
            const PerceptionParams& params, const std::optional<ExpectedPlace>& place,
            PoseResult& result) {
  result.status = PoseStatus::kNobody;
  state.looked_s = stamp_s;
  const auto window = search_window(image, place, state.looks++);
  if (!window) return;
  auto people = detect_people(image, *window, *network.detector, params.min_detection_score);
  result.candidates = static_cast<int>(people.size());
  people = possible(std::move(people), place, state.first, image);
  result.ambiguous = result.ambiguous || people.size() > 1;
  const auto candidates = look_at_people(state, image, stamp_s, network, params, people,
                                         place ? kMostTried : kMostCompared);
  for (const Candidate& c : candidates) {
    if (!c.pose) continue;
    result.ambiguous = result.ambiguous || c.judgement.doubtful || !c.judgement.theirs;
    result.difference = c.judgement.difference;
  }
  const Candidate* best = choose_candidate(state, candidates, !place);
  if (!place)
    for (const Candidate& c : candidates)
      if (&c != best) state.passed_over.push_back({c.region, c.pose, c.judgement.seen});
  if (!best) return;
  result.status = PoseStatus::kDetected;
  result.person = *best->pose;
  result.difference = best->judgement.difference;
  result.wears = best->judgement.seen;
  take(state, result.person, best->judgement, stamp_s, place && place->refused);
}

// In the region from the last image.
bool track(PoseState& state, const RgbImage& image, double stamp_s, PoseNetwork& network,
           const PerceptionParams& params, PoseResult& result) {
  const auto pose =
      find_landmarks(image, *state.chosen.region, *network.landmarks, params.min_pose_score);
  if (!pose) return false;
  result.person = *pose;
  const double jump_px = params.jump_ratio * state.chosen.size_px;
  if ((pose->torso_px() - state.chosen.torso_px).norm() > jump_px) return false;
  const Judgement j = judge(state, image, *pose, stamp_s, params);
  result.ambiguous = j.doubtful;
  result.difference = j.difference;
  result.wears = j.seen;
  if (!j.theirs) return false;
  take(state, *pose, j, stamp_s, false);
  return true;
}

}  // namespace

std::string_view to_string(PoseStatus status) {
  constexpr std::array<std::string_view, 5> names = {"tracked", "detected", "nobody", "not looked",
                                                     "bad image"};
  return names.at(static_cast<std::size_t>(status));
}

bool is_picture(const RgbImage& image) {
  const auto fits = [](int side) { return side >= 1 && side <= kMostSide_px; };
  return fits(image.width_px) && fits(image.height_px) &&
         image.rgb.size() == 3 * static_cast<std::size_t>(image.width_px) *
                                 static_cast<std::size_t>(image.height_px);
}

PoseResult perceive_image(PoseState& state, const RgbImage& image, double stamp_s,
                          PoseNetwork& network, const PerceptionParams& params,
                          const std::optional<ExpectedPlace>& expected) {
  PoseResult result;
  if (!is_picture(image)) return result;
  state.passed_over.clear();
  if (stamp_s < std::max(state.chosen.seen_s, state.looked_s)) begin_anew(state);
  if (!state.follows) {
    forget(state);
    state.chosen = {};
    result.status = PoseStatus::kNotLooked;
    if (stamp_s - state.looked_s >= params.watch_period_s)
      search(state, image, stamp_s, network, params, {}, result);
    return result;
  }
  const auto place = place_of_chosen(state.chosen, stamp_s, params, expected);
  if (!place) forget(state);
  state.place = torso_place(state.chosen, stamp_s, expected);
  if (expected && expected->refused) state.chosen.region.reset();
  if (state.chosen.region && track(state, image, stamp_s, network, params, result)) {
    result.status = PoseStatus::kTracked;
    return result;
  }
  state.chosen.region.reset();
  result.status = PoseStatus::kNotLooked;
  if (stamp_s - state.looked_s >= params.detector_period_s)
    search(state, image, stamp_s, network, params, place, result);
  return result;
}

void follow_other(PoseState& state, const std::optional<Appearance>& wears) {
  const PersonMemory before = std::exchange(state.chosen, {});
  state.other = before.region ? before : PersonMemory{};
  state.chosen.wears = wears;
  state.follows = true;
  state.looks = 0;
}

std::vector<PersonPose> find_people(const RgbImage& image, PoseNetwork& network,
                                    const PerceptionParams& params) {
  std::vector<PersonPose> people;
  if (!is_picture(image)) return people;
  for (int look = 0; look < kMostWindows && people.empty(); ++look) {
    const ImageRegion window = *search_window(image, std::nullopt, look);
    for (const auto& d :
         detect_people(image, window, *network.detector, params.min_detection_score))
      if (const auto found =
              find_landmarks(image, region_of_body(d), *network.landmarks, params.min_pose_score))
        people.push_back(*found);
  }
  return people;
}

TargetObservation to_observation(const PersonPose& person, double stamp_s,
                                 const CameraModel& camera, const PerceptionParams& params) {
  TargetObservation observation;
  observation.stamp_s = stamp_s;
  observation.camera = camera;
  observation.landmarks = person.landmarks;
  const Vec2& at_px = person.region.centre_px;
  const Vec3 ray((at_px.x() - camera.cx_px) / camera.fx_px,
                 (at_px.y() - camera.cy_px) / camera.fy_px, 1.0);
  const Quat q_camera_ray = Quat::FromTwoVectors(Vec3::UnitZ(), ray);
  for (Landmark& landmark : observation.landmarks)
    landmark.body_m =
        params.landmark_height_m / kNetworkHeight_m * (q_camera_ray * landmark.body_m);
  return observation;
}

}  // namespace foretrack
