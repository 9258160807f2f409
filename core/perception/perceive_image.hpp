// SPDX-License-Identifier: Apache-2.0
// Camera images → body landmarks of the person who is followed (paper §III.A: BlazePose).
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "core/common/image.hpp"
#include "core/common/target.hpp"
#include "core/perception/params.hpp"
#include "core/perception/person_memory.hpp"
#include "core/perception/pose_network.hpp"
#include "core/perception/search_window.hpp"

namespace foretrack {

enum class PoseStatus : std::uint8_t {
  kTracked,    // found in the region that the last image gave
  kDetected,   // found by the detector, and chosen
  kNobody,     // nobody in the window (or nobody within the gate)
  kNotLooked,  // lost, and the detector waits for its turn
  kBadImage,   // no pixels, or their number is not width × height
};
std::string_view to_string(PoseStatus status);

struct PoseResult {
  PoseStatus status = PoseStatus::kBadImage;
  PersonPose person;        // valid if found()
  int candidates = 0;       // people that the detector saw, if it ran
  bool ambiguous = false;   // it may be, or may have been, somebody else's pose
  double difference = 0.0;  // of the clothes from those that the chosen one wore
  bool found() const { return status == PoseStatus::kTracked || status == PoseStatus::kDetected; }
};

/// What is kept from image to image. A plain value; the caller owns it.
struct PoseState {
  PersonMemory chosen;
  PersonMemory other;       // the nearest one besides; watch_others() keeps it
  TorsoPlace place;         // of the chosen person in the last image, seen or expected
  double looked_s = -1e9;   // when the detector ran last
  double watched_s = -1e9;  // and when for others
  int looks = 0;            // of the detector since the chosen person was seen
  int watches = 0;          // of the detector for others
};

/// Landmarks of the chosen person: in the region from the last image while they are tracked, by the
/// detector (at most once in detector_period_s, in one search_window() after the other) otherwise.
/// The first time, the most certain person is chosen; then whoever is nearest to where the chosen
/// one is expected, within the gate, wears the same and is not the other one whom watch_others()
/// knows of. While that one is near, a pose is only taken if it is more like the chosen person's in
/// place, size and clothes, and clearly theirs: of a person who is covered there is no pose. A pose
/// that the filter refused may be somebody else's: it is not tracked on, the detector looks again.
/// Cost of a tracked image: about 6 ms with the lite model; with the detector 11 ms more. Stamps
/// must grow; one that goes back starts anew.
PoseResult perceive_image(PoseState& state, const RgbImage& image, double stamp_s,
                          PoseNetwork& network, const PerceptionParams& params,
                          const std::optional<ExpectedPlace>& expected = {});

/// Has pixels, and as many as it says.
bool is_picture(const RgbImage& image);

/// Everybody in one image that the detector finds, the most certain first.
std::vector<PersonPose> find_people(const RgbImage& image, PoseNetwork& network,
                                    const PerceptionParams& params);

/// As perceive() takes it: the joints are scaled to the height that the parameters say landmarks
/// are of, and turned to the camera's axes: the network sees nothing but the region, and takes
/// everybody to be in the middle of the image.
TargetObservation to_observation(const PersonPose& person, double stamp_s,
                                 const CameraModel& camera, const PerceptionParams& params);

}  // namespace foretrack
