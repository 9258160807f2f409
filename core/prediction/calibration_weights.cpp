#include "core/prediction/calibrate.hpp"

namespace foretrack {

const CalibrationWeights& calibration_weights(bool, bool) {
  static constexpr CalibrationWeights kWeights{.turn = {-2.5, 1.0, 0.0, 0.0, 0.0, 2.0},
                                               .decelerate = {-3.0, 0.0, 3.0}};
  return kWeights;
}

}  // namespace foretrack
