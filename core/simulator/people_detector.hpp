// SPDX-License-Identifier: Apache-2.0
// A detector of people in the colour camera's images, without images: where bystanders are, with
// the noise, delay, field of view and hidden sides of one.
#pragma once

#include <optional>
#include <vector>

#include "core/common/body_sighting.hpp"
#include "core/common/random.hpp"
#include "core/common/vehicle.hpp"
#include "core/simulator/bystander.hpp"

namespace foretrack {

/// Of the simulated detector of people.
struct PeopleDetectorParams {
  CameraModel camera;
  bool all_round = false;  // cameras on every side, where the one that follows looks ahead only
  double rate_hz = 10.0;
  double range_noise = 0.05;   // standard deviation, as a share of the distance
  double side_noise_m = 0.03;  // across the line of sight, at 4 m; grows with the distance
  double height_noise_m = 0.05;
  double dropout = 0.05;  // share of people who are missed in an image
  double delay_s = 0.05;  // from the image to its delivery
  double range_max_m = 8.0;
};

/// The simulated detector's state: noise, and when it looks next.
struct PeopleDetector {
  PeopleDetectorParams params;
  Random random{1};
  double next_image_s = 0.0;
  std::vector<BodySightings> waiting;  // oldest first
};
/// The same seed gives the same noise.
PeopleDetector make_people_detector(const PeopleDetectorParams& params, std::uint64_t seed);

/// Truth: whether somebody can be seen. At least half of the five body points must be in the image
/// and in range, and see the camera past the world, the followed person and the other people.
bool is_in_sight(const PeopleDetectorParams& params, const World& world,
                 const VehicleState& vehicle, std::span<const Person> people,
                 const Cylinder& followed, std::size_t whose);

/// Takes an image if one is due, and returns what was seen in the one whose delay is over: each
/// of those in sight, but for dropouts.
std::optional<BodySightings> detect(PeopleDetector& detector, const World& world,
                                    const VehicleState& vehicle, std::span<const Person> people,
                                    const Cylinder& followed);

}  // namespace foretrack
