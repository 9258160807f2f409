// SPDX-License-Identifier: Apache-2.0
// What RViz and Foxglove draw: paths and markers.
#pragma once

#include "core/common/prediction.hpp"
#include "core/common/target.hpp"
#include "core/common/trajectory.hpp"
#include "nav_msgs/msg/Path.h"
#include "visualization_msgs/msg/MarkerArray.h"

namespace foretrack {

/// The most probable path; empty without one.
void to_path(const Prediction& prediction, nav_msgs::msg::Path& out);
/// Ten poses a second, with the planned yaw.
void to_path(const PlannedTrajectory& plan, nav_msgs::msg::Path& out);

/// Each call replaces the markers of its namespaces.
void to_markers(const TargetState& target, visualization_msgs::msg::MarkerArray& out);
/// The reachable sectors, and a path per intention that fades with its probability.
void to_markers(const IntentionAssessment& intention, const Prediction& prediction,
                visualization_msgs::msg::MarkerArray& out);
/// The visible regions, the corridor's edges, and what is flown.
void to_markers(const PlannedTrajectory& plan, visualization_msgs::msg::MarkerArray& out);

}  // namespace foretrack
