// SPDX-License-Identifier: Apache-2.0
#include "core/tracker/follow_people.hpp"

#include <limits>

namespace foretrack {
namespace {

constexpr double kSame_m = 1.0;        // an observation nearer than that to the person is theirs
constexpr double kUnobserved_s = 0.2;  // after which a sighting counts as an observation
constexpr double kVerticalSigma_m = 0.1;
constexpr double kRadius_m = 0.25;

BodySighting sighting_of(const TorsoMeasurement& m, double height_m) {
  BodySighting seen{BodyKind::kPerson, m.position_enu_m, m.covariance_m2.topLeftCorner<2, 2>(),
                    kRadius_m, height_m};
  seen.position_enu_m.z() -= kTorsoShare * height_m;
  return seen;
}

TargetObservation observation_of(const BodySighting& seen, double stamp_s, double height_m) {
  TargetObservation out;
  out.stamp_s = stamp_s;
  out.kind = TargetObservation::Kind::kPosition;
  out.position_enu_m = seen.position_enu_m + kTorsoShare * height_m * Vec3::UnitZ();
  out.covariance_m2 = kVerticalSigma_m * kVerticalSigma_m * Mat3::Identity();
  out.covariance_m2.topLeftCorner<2, 2>() = seen.covariance_m2;
  return out;
}

double nearest_track_m(const BodiesState& bodies, const Vec3& place_enu_m) {
  double least_m = std::numeric_limits<double>::infinity();
  for (const BodyTrack& track : bodies.all())
    if (track.id != 0)
      least_m = std::min(least_m, (track.position_m() - place_enu_m.head<2>()).norm());
  return least_m;
}

}  // namespace

bool take_as_other(const PeopleTracks& people, const TargetObservation& observation,
                   const VehicleHistory& vehicle, const PeopleParams& params) {
  if (!people.choice.ordered) return false;
  const auto measured = measure_torso(observation, vehicle, params.perception);
  if (!measured) return false;
  const TargetState target = coast(people.target, observation.stamp_s, params.perception);
  const double away_m = distance_xy(measured->position_enu_m, target.position_enu_m);
  const bool theirs =
      target.usable() &&
      (away_m < kSame_m || away_m < nearest_track_m(people.bodies, measured->position_enu_m));
  if (theirs) return false;
  BodySightings seen;
  seen.stamp_s = observation.stamp_s;
  seen.add(sighting_of(*measured, params.perception.target_height_m));
  track_bodies(people.bodies, seen, target, params.bodies);
  return true;
}

bool take_sightings(const PeopleTracks& people, const BodySightings& seen,
                    std::span<const PersonLook> looks, const VehicleHistory& vehicle,
                    const PeopleParams& params) {
  const TargetState target = coast(people.target, seen.stamp_s, params.perception);
  const int row = track_bodies(people.bodies, seen, target, params.bodies, looks);
  if (row < 0 || !people.choice.ordered) return false;
  if (seen.stamp_s - target.last_measurement_s < kUnobserved_s) return false;
  perceive(people.target,
           observation_of(seen.bodies[row], seen.stamp_s, params.perception.target_height_m),
           vehicle, params.perception);
  return true;
}

ChoiceResult choose_person(const PeopleTracks& people, const ChoiceInput& input,
                           const PeopleParams& params) {
  ChoiceResult result = choose(people.choice, input, params.choice);
  if (!result.take_over) return result;
  const double height_m = params.perception.target_height_m;
  const TargetState before = coast(people.target, input.now_s, params.perception);
  if (*result.take_over == 0) {
    follow_no_body(people.bodies, before, height_m, params.bodies);
    people.target = {};
    return result;
  }
  const auto target =
      follow_body(people.bodies, *result.take_over, before,
                  result.by_order ? Numbers::kStay : Numbers::kSwap, height_m, params.bodies);
  if (target)
    start_at(people.target, *target);
  else
    result.take_over.reset();
  return result;
}

void begin_with(PoseState& state, const ChoiceParams& params) {
  state.first = static_cast<FirstChoice>(params.start);
  state.first_rgb = Vec3(params.start_red, params.start_green, params.start_blue);
}

}  // namespace foretrack
