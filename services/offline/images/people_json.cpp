// SPDX-License-Identifier: Apache-2.0
#include "services/offline/images/people_json.hpp"

namespace foretrack {
namespace {

using Json = nlohmann::ordered_json;

Json list_of(const Vec3& v) {
  return {v.x(), v.y(), v.z()};
}

Json json_of(const SeenPerson& person) {
  Json out, landmarks = Json::array();
  for (const Landmark& landmark : person.pose.landmarks)
    landmarks.push_back({{"x_px", landmark.image_px.x()},
                         {"y_px", landmark.image_px.y()},
                         {"visibility", landmark.visibility},
                         {"world_m", list_of(landmark.body_m)}});
  out["landmarks"] = std::move(landmarks);
  out["position_camera_m"] = person.place ? list_of(person.place->torso_camera_m) : Json();
  out["yaw_rad"] = person.place ? Json(person.place->yaw_rad) : Json();
  out["score"] = person.pose.score;
  return out;
}

}  // namespace

Json json_of(const SeenFrame& frame) {
  Json out;
  out["stamp_s"] = frame.stamp_s;
  if (!frame.file.empty()) out["file"] = frame.file;
  out["people"] = Json::array();
  for (const SeenPerson& person : frame.people) out["people"].push_back(json_of(person));
  return out;
}

}  // namespace foretrack
