// SPDX-License-Identifier: Apache-2.0
// People in an image → where they stand, and what the image shows of them.
#pragma once

#include <array>
#include <optional>
#include <span>

#include "core/common/body_sighting.hpp"
#include "core/common/person_look.hpp"
#include "core/common/vehicle.hpp"
#include "core/perception/watch_others.hpp"

namespace foretrack {

/// Others than the followed person in one image; looks[i] is of sightings.bodies[i].
struct PeopleSeen {
  BodySightings sightings;
  std::array<PersonLook, BodySightings::kCapacity> looks;
};

/// Everybody as tall as an adult: by their landmarks (perspective-n-point), or by how tall the
/// detector's box is. Range is then as uncertain as people's heights are. Image points are without
/// distortion. Nobody where the vehicle's pose at the image's stamp is not known.
void sight_people(std::span<const OtherPerson> people, double stamp_s, const CameraModel& camera,
                  const VehicleHistory& vehicle, const PerceptionParams& params, PeopleSeen& out);

/// What an observation with landmarks shows of the person. None: no pose of the vehicle or of the
/// body.
std::optional<PersonLook> look_of(const TargetObservation& observation,
                                  const VehicleHistory& vehicle, const PerceptionParams& params);

}  // namespace foretrack
