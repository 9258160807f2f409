// From scores to probabilities that mean what they say.
#pragma once

#include "core/prediction/assess_intention.hpp"

namespace foretrack {

/// Fills the probabilities of the beliefs; they sum to 1.
void calibrate(const MotionCues& motion, const Surroundings& surroundings,
               IntentionAssessment& assessment);

}  // namespace foretrack
