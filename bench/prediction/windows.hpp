// SPDX-License-Identifier: Apache-2.0
// Labelled moments of an episode, with what prediction knew.
#pragma once

#include <vector>

#include "bench/prediction/episodes.hpp"
#include "core/prediction/intentions/intention_table.hpp"

namespace foretrack::bench {

/// Where the features of each intention are in a window, and which head they are for. Mirrored
/// intentions share a head.
struct Heads {
  struct Place {
    int head = -1;  // none: the logit is 0
    int first = 0;
  };
  std::vector<const IntentionHead*> heads;
  std::vector<Place> places;  // of each row of the table
  int features = 0;           // of a window

  int size(int head) const { return heads[static_cast<std::size_t>(head)]->features; }
};
Heads heads_of(IntentionTable table);

struct Window {
  std::vector<float> features;  // of all intentions, as Heads says
  int label = 0;                // place in the table
};

/// One window every 0.12 s.
std::vector<Window> windows_of(const Episode& episode, const PredictionParams& params);

}  // namespace foretrack::bench
