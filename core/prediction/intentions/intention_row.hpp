// SPDX-License-Identifier: Apache-2.0
// What an intention is made of. Each has a file in this folder that fills in one row.
#pragma once

#include <algorithm>
#include <array>
#include <span>
#include <stdexcept>
#include <string_view>

#include "core/common/prediction.hpp"
#include "core/prediction/motion_cues.hpp"
#include "core/prediction/reachable_region.hpp"

namespace foretrack {

/// What the potentials and observations are worked out from.
struct IntentionEvidence {
  const MotionCues& motion;
  const Surroundings& surroundings;
  const PredictionParams& params;
  // The greatest of all other intentions; known when that at place 0 is scored, which comes last.
  double strongest_potential = 0.0;
  double strongest_observation = 0.0;
};

/// Where planning makes room for an intention: it widens this margin by its score.
enum class Margin : std::uint8_t { kNone, kLeft, kRight, kDistance };

/// Λ of the paper (§IV): what a path pays for changing from one intention to another.
struct ChangeCosts {
  double begin = 1.0;     // from the intention at place 0 to this one
  double end = 1.0;       // from this one to that at place 0
  double change = 1.0;    // from any other to this one
  double mirrored = 1.0;  // from its mirror image to this one
};

/// What the calibrated probability of one intention is a function of. Written in order; what is not
/// written is 0.
class FeatureVector {
 public:
  static constexpr int kCapacity = 64;
  void add(double value) { values_.at(static_cast<std::size_t>(count_++)) = value; }
  /// The first `count`, written or not.
  std::span<const double> first(int count) const {
    return std::span(values_).first(static_cast<std::size_t>(count));
  }
  int written() const { return count_; }

 private:
  std::array<double, kCapacity> values_{};
  int count_ = 0;
};

struct FeatureInputs {
  const IntentionEvidence& evidence;
  const IntentionBelief& own;  // its potential and observation are known
  bool map_known = false;
};

/// Fitted weights of one logit: a row and, for what matters only together (an opening and a wall
/// ahead), a layer of hidden units.
template <int kFeatures>
struct LogitWeights {
  using Row = std::array<double, kFeatures>;
  static constexpr int kHidden = 8;
  Row row{};
  std::array<Row, kHidden> hidden{};
  std::array<double, kHidden> hidden_bias{};
  std::array<double, kHidden> hidden_gain{};
};

/// The same without the number of features in its type. Empty: there are no fitted weights.
struct LogitView {
  std::span<const double> row;
  std::span<const double> hidden;  // row by row
  std::span<const double> hidden_bias;
  std::span<const double> hidden_gain;

  LogitView() = default;
  template <int kFeatures>
  explicit LogitView(const LogitWeights<kFeatures>& w)
      : row(w.row),
        hidden(w.hidden.front().data(), w.hidden.size() * w.row.size()),
        hidden_bias(w.hidden_bias),
        hidden_gain(w.hidden_gain) {}
  bool empty() const { return row.empty(); }
};

/// The fitted part of the model of one intention. Those that are each other's mirror image share
/// one.
struct IntentionHead {
  std::string_view name;  // of its weights: core/prediction/intentions/<name>_weights.cpp
  int features = 0;       // how many there are
  /// Without a map, or without a body yaw, other weights hold. Empty: not fitted.
  LogitView (*weights)(bool map_known, bool body_known) = nullptr;
};

/// All that the product knows of one intention: everybody else goes through the table, or reads
/// from the row.
struct IntentionRow {
  Intention id{};               // its place in the table
  std::string_view name;        // in messages, logs and files; at most 32 characters of [a-z_]
  std::uint32_t color_rgb = 0;  // 0xRRGGBB, wherever it is drawn
  Margin margin = Margin::kNone;
  double (*potential)(const IntentionEvidence&) = nullptr;                // R, eq. 5–10
  double (*observation)(const IntentionEvidence&) = nullptr;              // O
  MotionModel (*motion_model)(const PredictionParams& params) = nullptr;  // H of §IV
  ChangeCosts costs{};
  double noise_m2_s3 = 0.0;  // white acceleration: how the covariance along its path grows
  /// Null at place 0, whose logit is 0. Anywhere else, null or without weights: not fitted, and the
  /// probability is 0.
  const IntentionHead* head = nullptr;
  void (*features)(const FeatureInputs&, FeatureVector&) = nullptr;
};

using IntentionTable = std::span<const IntentionRow>;

/// Λ(from, to). Those that share a head are each other's mirror image.
constexpr double change_cost(const IntentionRow& from, const IntentionRow& to) {
  if (from.id == to.id) return 0.0;
  if (index_of(from.id) == 0) return to.costs.begin;
  if (index_of(to.id) == 0) return from.costs.end;
  return from.head && from.head == to.head ? to.costs.mirrored : to.costs.change;
}

}  // namespace foretrack
