// Written by bench/prediction/fit_intention; do not edit.
#include "core/prediction/calibrate.hpp"

namespace foretrack {
namespace {

// Fitted on simulated walks; 62654 windows: 44274 forward, 8431 left, 9013 right, 936 decelerate;
// log-loss 0.6321.
constexpr CalibrationWeights kMapAndBody{
    .turn = {-3.0481, 0.3211,  -1.0452, -1.2179, 0.5596,  0.2940,  -2.4420, 2.5995,
             1.5930,  2.4264,  -1.9756, -0.8409, -0.7399, -0.0107, 1.2479,  1.7551,
             -0.8149, -1.8248, 0.3365,  1.3631,  -0.0156, 1.3509,  -0.3884, 1.4757,
             -0.4120, 1.6260,  -0.5918, 0.6107,  -0.8693, 0.0248},
    .decelerate = {-5.4310, 0.9525, 0.1994, 0.3625, 0.0705, -0.3868, 0.2636, -0.0441, 0.1436,
                   0.0816},
};

// Fitted on simulated walks, yaw hidden; 62654 windows: 44274 forward, 8431 left, 9013 right, 936
// decelerate; log-loss 0.7628.
constexpr CalibrationWeights kMapOnly{
    .turn = {-0.8482, 0.1799,  -0.9474, -1.2835, -0.2656, 0.0000, 0.0000,  0.0000,
             1.3321,  1.9989,  -1.7817, -1.0147, -0.1695, 0.1674, 1.7601,  1.6246,
             -0.4657, -2.6456, 0.3531,  2.0901,  0.0296,  1.6231, -0.3338, 1.6036,
             -0.4014, 1.7628,  -0.5928, 0.7229,  -0.8096, 0.1356},
    .decelerate = {-5.3406, 0.9241, 0.2198, 0.2118, 0.0066, 0.0000, 0.2865, -0.0677, 0.1211,
                   0.0614},
};

// Fitted on simulated walks, map hidden; 62654 windows: 44274 forward, 8431 left, 9013 right, 936
// decelerate; log-loss 0.6673.
constexpr CalibrationWeights kBodyOnly{
    .turn = {-3.6702, 0.3306, -1.0320, -1.2039, 1.1344, 0.1670, -2.2607, 2.7534, 0.0000, 0.0000,
             0.0000,  0.0000, 0.0000,  0.0000,  0.0000, 0.0000, 0.0000,  0.0000, 0.0000, 0.0000,
             0.0000,  0.0000, 0.0000,  0.0000,  0.0000, 0.0000, 0.0000,  0.0000, 0.0000, 0.0000},
    .decelerate = {-5.4475, 0.9857, 0.1913, 0.3644, 0.0728, -0.3790, 0.0000, 0.0000, 0.0000,
                   0.0000},
};

// Fitted on UCY zara01 pedestrians; 5707 windows: 5535 forward, 70 left, 52 right, 50 decelerate;
// log-loss 0.1586.
constexpr CalibrationWeights kTrackOnly{
    .turn = {-3.1541, -0.1101, 0.4459, -0.3204, -1.3191, 0.0000, 0.0000, 0.0000, 0.0000, 0.0000,
             0.0000,  0.0000,  0.0000, 0.0000,  0.0000,  0.0000, 0.0000, 0.0000, 0.0000, 0.0000,
             0.0000,  0.0000,  0.0000, 0.0000,  0.0000,  0.0000, 0.0000, 0.0000, 0.0000, 0.0000},
    .decelerate = {-2.9135, -2.1218, -1.1058, -0.1087, 0.4047, 0.0000, 0.0000, 0.0000, 0.0000,
                   0.0000},
};

}  // namespace

const CalibrationWeights& calibration_weights(bool map_known, bool body_known) {
  if (map_known) return body_known ? kMapAndBody : kMapOnly;
  return body_known ? kBodyOnly : kTrackOnly;
}

}  // namespace foretrack
