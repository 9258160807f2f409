#include "core/prediction/calibrate.hpp"

namespace foretrack {

void calibrate(const MotionCues&, const Surroundings&, IntentionAssessment& assessment) {
  double sum = 0.0;
  for (auto& b : assessment.beliefs) sum += b.probability = std::exp(4.0 * b.score);
  for (auto& b : assessment.beliefs) b.probability /= sum;
}

}  // namespace foretrack
