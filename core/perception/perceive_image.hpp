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

/// How the chosen person was found in an image, or why not.
enum class PoseStatus : std::uint8_t {
  kTracked,    ///< found in the region that the last image gave
  kDetected,   ///< found by the detector, and chosen
  kNobody,     ///< nobody in the window, or nobody within the gate
  kNotLooked,  ///< lost, and the detector waits for its turn
  kBadImage,   ///< no pixels, or their number is not width × height
};
/// For logs and displays.
std::string_view to_string(PoseStatus status);

/// Which of several is followed when nobody was yet.
enum class FirstChoice : std::uint8_t {
  kCertain,  ///< of whom the detector is most certain
  kNearest,  ///< who is tallest in the image
  kMiddle,   ///< who is nearest to the image's middle
  kColor,    ///< whose torso is of a described colour; nobody, as long as nobody's is
};

/// Somebody else in one image.
struct OtherPerson {
  ImageRegion region;                    ///< around the hips, 1.25 times as large as the body
  std::optional<PersonPose> pose = {};   ///< none: only the detector saw them
  std::optional<Appearance> wears = {};  ///< none: not seen
};

/// What one image gave.
struct PoseResult {
  PoseStatus status = PoseStatus::kBadImage;
  PersonPose person;                ///< valid if found()
  int candidates = 0;               ///< people whom the detector saw, if it ran
  bool ambiguous = false;           ///< it may be, or may have been, somebody else's pose
  double difference = 0.0;          ///< of the clothes from those that the chosen person wore
  std::optional<Appearance> wears;  ///< of the person, in this image
  /// True if there is a pose.
  bool found() const { return status == PoseStatus::kTracked || status == PoseStatus::kDetected; }
};

/// What is kept from image to image. A plain value; the caller owns it.
struct PoseState {
  FirstChoice first = FirstChoice::kCertain;  ///< for the caller to set
  Vec3 first_rgb = Vec3::Zero();              ///< for kColor, 0 to 255
  bool follows = true;      ///< false: nobody is to be followed; everybody is looked at
  PersonMemory chosen;      ///< the person who is followed
  PersonMemory other;       ///< the nearest person besides; watch_others() keeps it
  TorsoPlace place;         ///< of the chosen person in the last image, seen or expected
  double looked_s = -1e9;   ///< stamp of the image in which the detector looked for them last
  double watched_s = -1e9;  ///< and of that in which it looked for others
  int looks = 0;            ///< of the detector since the chosen person was seen
  int watches = 0;          ///< of the detector for others
  std::vector<OtherPerson> passed_over;  ///< in the last image: seen, and not taken for the person
};

/// The landmarks of the chosen person in one image.
///
/// While they are tracked, they are looked for in the region that the last image gave. Otherwise
/// the detector looks for them, at most once in detector_period_s, in one search_window() after the
/// other.
///
/// The first time, state.first says who is chosen. From then on it is whoever is nearest to
/// where the chosen person is expected, is within the gate and wears the same. `expected` is where
/// the filter expects them; without it, where they were seen last counts. Once nobody knows any
/// more where they are, it is who wears the same, if that is one alone.
///
/// While another person is near (state.other, see watch_others()), a pose is taken only if it is
/// clearly more like the chosen person's in place, size and clothes. Of a person who is covered by
/// another one there is no pose. A pose that the filter refused may be somebody else's: it is not
/// tracked on, and the detector looks again.
///
/// Stamps must grow; one that goes back starts anew. Never throws for an image, however bad. Cost
/// of a tracked image: about 6 ms with the lite model; of one with the detector 11 ms more.
PoseResult perceive_image(PoseState& state, const RgbImage& image, double stamp_s,
                          PoseNetwork& network, const PerceptionParams& params,
                          const std::optional<ExpectedPlace>& expected = {});

/// Somebody else is followed from now on, who wears that; where they are, the filter must expect
/// them. Who was followed so far is told from them.
void follow_other(PoseState& state, const std::optional<Appearance>& wears);

/// True if the image has pixels, as many as it says, and no side is longer than 16384.
bool is_picture(const RgbImage& image);

/// Everybody whom the detector finds in one image, the most certain first. Where nobody is found in
/// the whole image, its parts are looked at too. Cost: 11 ms for each look, and that of the
/// landmark network for each person.
std::vector<PersonPose> find_people(const RgbImage& image, PoseNetwork& network,
                                    const PerceptionParams& params);

/// A pose as perceive() takes it. Joints are scaled from kNetworkHeight_m to landmark_height_m.
/// They are also turned to the camera's axes: the network sees nothing but the region, and takes
/// everybody to be in the middle of the image.
TargetObservation to_observation(const PersonPose& person, double stamp_s,
                                 const CameraModel& camera, const PerceptionParams& params);

}  // namespace foretrack
