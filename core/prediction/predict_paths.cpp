// SPDX-License-Identifier: Apache-2.0
#include "core/prediction/predict_paths.hpp"

#include <algorithm>

#include "core/common/white_acceleration.hpp"

namespace foretrack {
namespace {

using Mat4 = Eigen::Matrix4d;

// Covariance of the horizontal (position, velocity).
Mat4 planar_covariance(const TargetState& target) {
  Mat4 c;
  c.topLeftCorner<2, 2>() = target.covariance.topLeftCorner<2, 2>();
  c.topRightCorner<2, 2>() = target.covariance.block<2, 2>(0, 3);
  c.bottomLeftCorner<2, 2>() = target.covariance.block<2, 2>(3, 0);
  c.bottomRightCorner<2, 2>() = target.covariance.block<2, 2>(3, 3);
  return c;
}

// Where all paths begin.
struct PathStart {
  PlanarState state;
  double height_m = 0.0;
  Mat4 covariance = Mat4::Zero();
};

// One step of a covariance through a motion model, with white acceleration of density q.
Mat4 grown(const Mat4& covariance, const MotionJacobian& j, double dt_s, double q) {
  Mat4 f = Mat4::Identity();
  f.topRightCorner<2, 2>() = j.position_by_velocity;
  f.bottomRightCorner<2, 2>() = j.velocity_by_velocity;
  Mat4 after = f * covariance * f.transpose();
  add_white_acceleration<2>(after, Vec2::Constant(q), dt_s);
  return after;
}

PredictedPath& start_path(PredictionState& state, const IntentionRow& row) {
  auto& paths = state.result.prediction.paths;
  PredictedPath& path = paths.emplace_back();
  path.intention = row.id;
  path.probability = state.result.intention[row.id].probability;
  path.states.swap(state.spare_paths.back());
  state.spare_paths.pop_back();
  path.states.clear();
  return path;
}

// Walks along the primitives and notes each end with its covariance.
class PathWriter {
 public:
  PathWriter(PredictionState& state, const IntentionRow& row, const PathStart& start, double step_s)
      : path_(start_path(state, row)),
        step_s_(step_s),
        noise_m2_s3_(row.noise_m2_s3),
        height_m_(start.height_m),
        x_(start.state),
        covariance_(start.covariance) {}

  void add(const MotionModel& model) {
    covariance_ = grown(covariance_, jacobian(model, x_, step_s_), step_s_, noise_m2_s3_);
    x_ = advance(model, x_, step_s_);
    PredictedState& z = path_.states.emplace_back();
    z.time_s = static_cast<double>(path_.states.size()) * step_s_;
    z.position_enu_m << x_.position_m, height_m_;
    z.velocity_enu_m_s << x_.velocity_m_s, 0.0;
    z.covariance_m2 = covariance_.topLeftCorner<2, 2>();
  }

  PredictedPath& path() { return path_; }

 private:
  PredictedPath& path_;
  double step_s_, noise_m2_s3_;
  double height_m_;
  PlanarState x_;
  Mat4 covariance_;
};

// From here, constant velocity leads where the target will soon be, at the velocity that it will
// have then: all paths begin with what shows already.
PlanarState start_of(const MotionCues& motion) {
  return {motion.soon.position_m - ShortTermMotion::kSoon_s * motion.soon.velocity_m_s,
          motion.soon.velocity_m_s};
}

// The one path that there is, of the intention at place 0.
void add_only_path(PredictionState& state, const IntentionRow& on, const PathStart& start,
                   const MotionModel& model, const PredictionParams& params) {
  PathWriter writer(state, on, start, params.step_s);
  writer.path().probability = 1.0;
  for (int k = 0; k < params.step_count(); ++k) writer.add(model);
}

void add_blocked_path(PredictionState& state, const IntentionRow& on, const PathStart& start,
                      const PredictionParams& params) {
  state.result.prediction.status = PredictionStatus::kTargetBlocked;
  add_only_path(state, on, start, MotionModel::deceleration(params.deceleration_m_s2), params);
}

// Constant velocity, whatever stands in its way: to compare with.
void add_straight_path(PredictionState& state, const IntentionRow& on, const PathStart& start,
                       const PredictionParams& params) {
  add_only_path(state, on, start, MotionModel::constant_velocity(), params);
}

SearchStatus add_searched_path(PredictionState& state, const PathStart& start,
                               const SearchRequest& request, const GridMap& map,
                               const PredictionParams& params, IntentionTable table) {
  const SearchOutcome outcome = search_path(request, map, params, state.search, table);
  state.result.prediction.expansions += outcome.expansions;
  if (outcome.status != SearchStatus::kFound) return outcome.status;
  PathWriter writer(state, row_of(request.root, table), start, params.step_s);
  for (const std::int32_t i : state.search.path)
    writer.add(row_of(state.search.nodes[i].intention, table).motion_model(params, request.gait));
  return outcome.status;
}

// Place in the table, the likeliest first.
std::array<Intention, kMaxIntentions> likeliest_first(const IntentionAssessment& assessment) {
  std::array<Intention, kMaxIntentions> order{};
  for (int i = 0; i < assessment.count; ++i) order[i] = static_cast<Intention>(i);
  std::sort(order.begin(), order.begin() + assessment.count, [&](Intention a, Intention b) {
    const double p = assessment[a].probability, q = assessment[b].probability;
    return p != q ? p > q : a < b;
  });
  return order;
}

// Who stands has no path to bend, and who has stood for a while none to go back.
bool has_a_path(const MotionModel& model, const MotionCues& motion,
                const PredictionParams& params) {
  if (model.kind == MotionModel::Kind::kCoordinatedTurn) return motion.walking;
  if (model.kind == MotionModel::Kind::kReversal)
    return motion.gait.pace_m_s >= params.walking_speed_m_s;
  return true;
}

void normalise(std::vector<PredictedPath>& paths) {
  double sum = 0.0;
  for (const auto& path : paths) sum += path.probability;
  for (auto& path : paths) path.probability /= sum;
}

}  // namespace

void clear_prediction(PredictionState& state, double stamp_s, PredictionStatus status) {
  Prediction& prediction = state.result.prediction;
  prediction.stamp_s = stamp_s;
  prediction.status = status;
  prediction.expansions = 0;
  auto& paths = prediction.paths;
  state.spare_paths.reserve(kMaxIntentions);
  paths.reserve(kMaxIntentions);
  for (auto& path : paths) state.spare_paths.push_back(std::move(path.states));
  paths.clear();
  state.spare_paths.resize(kMaxIntentions);
}

void predict_paths(PredictionState& state, const TargetState& target, const MotionCues& motion,
                   const GridMap& map, const PredictionParams& params, IntentionTable table) {
  clear_prediction(state, target.stamp_s, PredictionStatus::kOk);
  Prediction& prediction = state.result.prediction;
  PathStart start{params.intention_paths ? start_of(motion) : motion.state, motion.height_m,
                  planar_covariance(target)};
  const IntentionRow& on = table.front();
  if (!params.around_obstacles) return add_straight_path(state, on, start, params);
  const Vec2& place_m = motion.state.position_m;
  if (map.is_occupied({place_m.x(), place_m.y(), motion.height_m}))
    return add_blocked_path(state, on, start, params);
  const auto order = likeliest_first(state.result.intention);
  for (const Intention intention : std::span(order).first(table.size())) {
    if (!params.intention_paths && intention != on.id) continue;
    const MotionModel model = row_of(intention, table).motion_model(params, motion.gait);
    if (!has_a_path(model, motion, params)) continue;
    const double probability = state.result.intention[intention].probability;
    if (!prediction.paths.empty() && probability < params.path_probability_min) break;
    const SearchRequest request{start.state, motion.height_m, motion.gait, motion.recent_turn_rad,
                                intention};
    if (add_searched_path(state, start, request, map, params, table) == SearchStatus::kExhausted)
      prediction.status = PredictionStatus::kSearchExhausted;
  }
  if (prediction.paths.empty()) add_blocked_path(state, on, start, params);
  normalise(prediction.paths);
}

}  // namespace foretrack
