#include "core/perception/perceive_image.hpp"

namespace foretrack {

std::string_view to_string(PoseStatus status) {
  constexpr std::array<std::string_view, 5> names = {"tracked", "detected", "nobody", "not looked",
                                                     "bad image"};
  return names.at(static_cast<std::size_t>(status));
}

PoseResult perceive_image(PoseState&, const RgbImage&, double, PoseNetwork&,
                          const PerceptionParams&, const std::optional<ExpectedPlace>&) {
  return {};
}

std::vector<PersonPose> find_people(const RgbImage&, PoseNetwork&, const PerceptionParams&) {
  return {};
}

TargetObservation to_observation(const PersonPose& person, double stamp_s,
                                 const CameraModel& camera, const PerceptionParams& params) {
  TargetObservation observation;
  observation.stamp_s = stamp_s;
  observation.camera = camera;
  observation.landmarks = person.landmarks;
  for (Landmark& landmark : observation.landmarks)
    landmark.body_m *= params.landmark_height_m / kNetworkHeight_m;
  return observation;
}

}  // namespace foretrack
