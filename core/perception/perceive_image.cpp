#include "core/perception/perceive_image.hpp"

#include <algorithm>

#include "core/perception/detect_people.hpp"

namespace foretrack {
namespace {

constexpr double kLearnt = 0.15;  // of new looks, in each image
constexpr int kMostSide_px = 16384;
constexpr double kRegionOverBody = 1.25;  // side of a region over the height of who stands in it

bool is_picture(const RgbImage& image) {
  const auto fits = [](int side) { return side >= 1 && side <= kMostSide_px; };
  return fits(image.width_px) && fits(image.height_px) &&
         image.rgb.size() == 3 * static_cast<std::size_t>(image.width_px) *
                                 static_cast<std::size_t>(image.height_px);
}

// Who wears something else is somebody else.
bool wears_the_same(const PoseState& state, const RgbImage& image, const PerceptionParams& params,
                    PoseResult& result) {
  const auto seen = appearance_of(image, result.person);
  result.difference = seen && state.wears ? difference(*seen, *state.wears) : 0.0;
  return result.difference <= params.clothes_gate;
}

// Clothes are not learnt while the filter refuses the poses.
void remember(PoseState& state, const RgbImage& image, const PersonPose& person, double stamp_s,
              bool doubtful) {
  const auto seen = appearance_of(image, person);
  if (seen && state.wears && !doubtful) learn(*state.wears, *seen, kLearnt);
  if (seen && !state.wears) state.wears = seen;
  state.region = person.tracked;
  state.torso_px = person.torso_px();
  state.size_px = person.tracked.size_px;
  state.seen_s = stamp_s;
  state.looks = 0;
}

// Where the chosen person may be; none: anybody may be chosen.
std::optional<ExpectedPlace> place_of_chosen(const PoseState& state, double stamp_s,
                                             const PerceptionParams& params,
                                             const std::optional<ExpectedPlace>& expected) {
  if (expected) return expected;
  const double age_s = stamp_s - state.seen_s;
  if (age_s > params.choice_memory_s) return std::nullopt;
  return ExpectedPlace{state.torso_px, state.size_px * params.choice_gate_ratio * (1.0 + age_s),
                       state.size_px / kRegionOverBody};
}

// Middle of the torso: halfway between hips and shoulders.
Vec2 torso_of(const Detection& d) {
  return 0.5 * (d.points_px[0] + d.points_px[2]);
}

struct Choice {
  const Detection* person = nullptr;
  int possible = 0;
};

Choice choose(const std::vector<Detection>& people, const std::optional<ExpectedPlace>& place) {
  Choice choice;
  if (!place) return {people.empty() ? nullptr : &people.front(), static_cast<int>(people.size())};
  double least = place->gate_px;
  for (const Detection& person : people) {
    const double distance = (torso_of(person) - place->torso_px).norm();
    if (distance > place->gate_px) continue;
    ++choice.possible;
    if (distance <= least) least = distance, choice.person = &person;
  }
  return choice;
}

void search(PoseState& state, const RgbImage& image, double stamp_s, PoseNetwork& network,
            const PerceptionParams& params, const std::optional<ExpectedPlace>& place,
            PoseResult& result) {
  result.status = PoseStatus::kNobody;
  state.looked_s = stamp_s;
  const auto window = search_window(image, place, state.looks++);
  if (!window) return;
  const auto people = detect_people(image, *window, *network.detector, params.min_detection_score);
  const Choice choice = choose(people, place);
  result.candidates = static_cast<int>(people.size());
  result.ambiguous = choice.possible > 1;
  if (!choice.person) return;
  const auto& points = choice.person->points_px;
  const auto found = find_landmarks(image, region_of_body(points[0], points[1]), *network.landmarks,
                                    params.min_pose_score);
  if (!found) return;
  result.person = *found;
  if (!place) state.wears.reset();
  if (!wears_the_same(state, image, params, result)) return;
  result.status = PoseStatus::kDetected;
  remember(state, image, *found, stamp_s, place && place->refused);
}

}  // namespace

std::string_view to_string(PoseStatus status) {
  constexpr std::array<std::string_view, 5> names = {"tracked", "detected", "nobody", "not looked",
                                                     "bad image"};
  return names.at(static_cast<std::size_t>(status));
}

PoseResult perceive_image(PoseState& state, const RgbImage& image, double stamp_s,
                          PoseNetwork& network, const PerceptionParams& params,
                          const std::optional<ExpectedPlace>& expected) {
  PoseResult result;
  if (!is_picture(image)) return result;
  if (stamp_s < std::max(state.seen_s, state.looked_s)) state = {};
  if (expected && expected->refused) state.region.reset();
  if (state.region) {
    const auto found =
        find_landmarks(image, *state.region, *network.landmarks, params.min_pose_score);
    const double jump_px = params.jump_ratio * state.size_px;
    if (found) result.person = *found;
    if (found && (found->torso_px() - state.torso_px).norm() <= jump_px &&
        wears_the_same(state, image, params, result)) {
      result.status = PoseStatus::kTracked;
      remember(state, image, *found, stamp_s, false);
      return result;
    }
    state.region.reset();
  }
  result.status = PoseStatus::kNotLooked;
  if (stamp_s - state.looked_s < params.detector_period_s) return result;
  const auto place = place_of_chosen(state, stamp_s, params, expected);
  search(state, image, stamp_s, network, params, place, result);
  return result;
}

std::vector<PersonPose> find_people(const RgbImage& image, PoseNetwork& network,
                                    const PerceptionParams& params) {
  std::vector<PersonPose> people;
  if (!is_picture(image)) return people;
  for (int look = 0; look < kMostWindows && people.empty(); ++look) {
    const ImageRegion window = *search_window(image, std::nullopt, look);
    for (const auto& d :
         detect_people(image, window, *network.detector, params.min_detection_score))
      if (const auto found = find_landmarks(image, region_of_body(d.points_px[0], d.points_px[1]),
                                            *network.landmarks, params.min_pose_score))
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
