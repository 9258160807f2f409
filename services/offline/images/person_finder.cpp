// SPDX-License-Identifier: Apache-2.0
#include "services/offline/images/person_finder.hpp"

#include <fmt/format.h>

#include <stdexcept>

#include "core/perception/undistort_person.hpp"
#include "core/perception/watch_others.hpp"

namespace foretrack {

PersonFinder::PersonFinder(PoseNetwork network, const PerceptionParams& params,
                           std::optional<CameraWithLens> calibration)
    : network_(std::move(network)), params_(params), calibration_(std::move(calibration)) {}

SeenFrame PersonFinder::look(const Frame& picture) {
  check_size(picture);
  SeenFrame out{picture.stamp_s, picture.file, {}};
  for (const PersonPose& pose : find_people(picture.image, network_, params_))
    out.people.push_back(seen(pose));
  return out;
}

SeenFrame PersonFinder::follow(const Frame& frame) {
  check_size(frame);
  SeenFrame out{frame.stamp_s, frame.file, {}};
  const PoseResult result = perceive_image(state_, frame.image, frame.stamp_s, network_, params_);
  watch_others(state_, frame.image, frame.stamp_s, network_, params_);
  if (result.status == PoseStatus::kDetected) ambiguous_ = result.ambiguous;
  if (result.found()) out.people.push_back(seen(result.person));
  return out;
}

SeenPerson PersonFinder::seen(const PersonPose& pose) const {
  SeenPerson person{pose, std::nullopt};
  if (!calibration_) return person;
  PersonPose straight = pose;
  undistort(straight, calibration_->camera, calibration_->lens);
  person.place = locate_body(straight, calibration_->camera, params_);
  return person;
}

void PersonFinder::check_size(const Frame& frame) const {
  if (!calibration_) return;
  const CameraModel& camera = calibration_->camera;
  if (frame.image.width_px == camera.width_px && frame.image.height_px == camera.height_px) return;
  throw std::runtime_error(fmt::format("{}the image has {} × {} pixels, the calibration {} × {}",
                                       frame.file.empty() ? "" : frame.file + ": ",
                                       frame.image.width_px, frame.image.height_px, camera.width_px,
                                       camera.height_px));
}

}  // namespace foretrack
