// SPDX-License-Identifier: Apache-2.0
// The person who is followed and everybody else, together: whose an observation is, who is
// followed, and the change from one to another.
#pragma once

#include "core/bodies/bodies_around.hpp"
#include "core/bodies/follow_body.hpp"
#include "core/choice/choose.hpp"
#include "core/perception/perceive.hpp"
#include "core/perception/perceive_image.hpp"

namespace foretrack {

/// What people are tracked by; the caller owns it.
struct PeopleTracks {
  PerceptionState& target;
  BodiesState& bodies;
  ChoiceState& choice;
};

/// The parameters of all three.
struct PeopleParams {
  const PerceptionParams& perception;
  const BodyParams& bodies;
  const ChoiceParams& choice;
};

/// Once an operator said whom to follow, an observation that somebody else made may be of another
/// person. Then it counts as a sighting of them. True: it was.
bool take_as_other(const PeopleTracks& people, const TargetObservation& observation,
                   const VehicleHistory& vehicle, const PeopleParams& params);

/// Sightings of one frame. Of a person who was chosen by an operator, and of whom there was no
/// observation lately, a sighting counts as one. True: the followed person's state has changed.
bool take_sightings(const PeopleTracks& people, const BodySightings& seen,
                    std::span<const PersonLook> looks, const VehicleHistory& vehicle,
                    const PeopleParams& params);

/// choose(), and what it decides is done: the track of the followed person begins anew at another
/// one, or ends. Numbers are as follow_body() says.
ChoiceResult choose_person(const PeopleTracks& people, const ChoiceInput& input,
                           const PeopleParams& params);

/// Whom images shall begin with, as the parameters say.
void begin_with(PoseState& state, const ChoiceParams& params);

}  // namespace foretrack
