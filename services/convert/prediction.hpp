// SPDX-License-Identifier: Apache-2.0
// Intentions and predicted paths.
#pragma once

#include "core/common/prediction.hpp"
#include "foretrack_msgs/msg/TargetIntention.h"
#include "foretrack_msgs/msg/TargetPrediction.h"
#include "services/convert/checks.hpp"

namespace foretrack {

void to_idl(const IntentionAssessment& assessment, foretrack_msgs::msg::TargetIntention& out);
Converted<IntentionAssessment> from_idl(const foretrack_msgs::msg::TargetIntention& in);

/// Throws std::length_error beyond the bounds of the IDL.
void to_idl(const Prediction& prediction, foretrack_msgs::msg::TargetPrediction& out);
Converted<Prediction> from_idl(const foretrack_msgs::msg::TargetPrediction& in);

}  // namespace foretrack
