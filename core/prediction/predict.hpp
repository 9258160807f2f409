// SPDX-License-Identifier: Apache-2.0
// The prediction stage: what the target means to do, and where that would lead.
#pragma once

#include "core/common/grid_map.hpp"
#include "core/common/prediction.hpp"
#include "core/common/target.hpp"
#include "core/prediction/intention_search.hpp"
#include "core/prediction/motion_cues.hpp"
#include "core/prediction/params.hpp"

namespace foretrack {

struct PredictionResult {
  IntentionAssessment intention;
  Prediction prediction;
};

/// One for each target, owned by the caller: what the target did, and all workspaces.
struct PredictionState {
  MotionMemory memory;
  SearchWorkspace search;
  PredictionResult result;
  std::vector<std::vector<PredictedState>> spare_paths;
};

/// Assesses the intentions and predicts one path for each that is possible here and not too
/// unlikely (path_probability_min); the path probabilities are those of the intentions, normalised
/// over the paths. All paths begin with what the last moments tell of the next (ShortTermMotion).
/// The result is valid until the next call. Without a usable target: kNoTarget and no
/// path. Allocates nothing after the first calls. Cost: about 0.03 ms. Source: Ren et al. 2024,
/// §III.B, §III.C, §IV; the probabilities and one path per intention are ours.
const PredictionResult& predict(PredictionState& state, const TargetState& target,
                                const GridMap& map, const PredictionParams& params,
                                IntentionTable table = kIntentions);

}  // namespace foretrack
