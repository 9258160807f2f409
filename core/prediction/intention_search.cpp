// SPDX-License-Identifier: Apache-2.0
#include "core/prediction/intention_search.hpp"

#include <algorithm>

namespace foretrack {
namespace {

double clearance_at(const GridMap& map, double height_m, const Vec2& position_m) {
  return map.occupied_distance_m(Vec3(position_m.x(), position_m.y(), height_m));
}

// At place 0: to go on.
constexpr Intention kOn{};

struct Search {
  const SearchRequest& request;
  const GridMap& map;
  const PredictionParams& params;
  SearchWorkspace& w;
  IntentionTable table;
  std::array<MotionModel, kMaxIntentions> models;
  int steps = 0;
  double root_side = 0.0;     // +1, −1: the root intention is to turn left, right
  double turn_limit_rad = 0;  // of the root intention
  Vec2 side_axis;             // to the left of the present course
  Vec2 goal_m = Vec2::Zero();

  Search(const SearchRequest& r, const GridMap& m, const PredictionParams& p, SearchWorkspace& ws,
         IntentionTable t)
      : request(r), map(m), params(p), w(ws), table(t), steps(p.step_count()) {
    for (const IntentionRow& row : table) models[index_of(row.id)] = row.motion_model(p);
    if (turns(request.root)) root_side = root_model().rate > 0.0 ? 1.0 : -1.0;
    const double begun_rad = std::max(0.0, root_side * r.recent_turn_rad);
    const Vec2 course = r.start.velocity_m_s.normalized();
    side_axis = Vec2(-course.y(), course.x());
    turn_limit_rad = std::max(p.max_turn_rad - begun_rad, p.min_turn_rad);
  }

  const MotionModel& model_of(Intention i) const { return models[index_of(i)]; }
  const MotionModel& root_model() const { return model_of(request.root); }
  bool turns(Intention i) const { return model_of(i).kind == MotionModel::Kind::kCoordinatedTurn; }
  bool slows(Intention i) const { return model_of(i).kind == MotionModel::Kind::kDeceleration; }
  double change_cost(Intention from, Intention to) const {
    return foretrack::change_cost(row_of(from, table), row_of(to, table));
  }
  double remaining_s(int step) const { return (steps - step) * params.step_s; }

  double turn_left_to_do_rad(double turned_rad) const {
    return root_side == 0.0 ? 0.0 : std::max(0.0, turn_limit_rad - root_side * turned_rad);
  }

  // e(n): where the root intention, followed freely from here, would be at T_p.
  Vec2 free_end_m(const PlanarState& x, double turned_rad, int step) const {
    const double rest_s = remaining_s(step);
    if (root_side == 0.0) return advance(root_model(), x, rest_s).position_m;
    const double to_do_s = turn_left_to_do_rad(turned_rad) / std::abs(root_model().rate);
    const double turn_s = std::min(rest_s, to_do_s);
    const PlanarState after = advance(root_model(), x, turn_s);
    return after.position_m + (rest_s - turn_s) * after.velocity_m_s;
  }

  // The paper's h pulls every path to where constant velocity leads, against a turn. This one
  // measures how far the node already puts the root intention's own end out of place.
  double heuristic(const SearchNode& n) const {
    const Vec2 end = free_end_m(n.state, n.turned_rad, n.step);
    double h = params.goal_weight * (end - goal_m).norm() + params.eagerness * (steps - n.step);
    const double to_do_rad = turn_left_to_do_rad(n.turned_rad);
    if (to_do_rad < half_turn_rad()) return h;
    if (n.intention != request.root) h += change_cost(n.intention, request.root);
    if (to_do_rad + half_turn_rad() < std::abs(root_model().rate) * remaining_s(n.step))
      h += change_cost(request.root, kOn);
    return h;
  }
  double half_turn_rad() const { return 0.5 * params.turn_rate_rad_s * params.step_s; }

  bool is_allowed(const SearchNode& from, const SearchNode& to) const;
  bool can_still_leave(const SearchNode& n) const;
  double way_from_course_m(const SearchNode& n) const {
    return root_side * side_axis.dot(n.state.position_m - request.start.position_m);
  }
  bool is_allowed_before_turn(const SearchNode& from, const SearchNode& to) const;

  std::uint64_t key_of(const SearchNode& n) const;
  bool is_better_than_seen(const SearchNode& n);
  void push(const SearchNode& n);
  void expand(std::int32_t index);
  void keep_path(std::int32_t leaf);
  SearchOutcome run();
};

std::uint64_t quantised(double value, double unit) {
  return static_cast<std::uint64_t>(static_cast<std::int64_t>(std::floor(value / unit + 0.5))) &
         0xFFF;
}

// Nodes within 5 cm and 5 cm/s of each other that can go on in the same ways are one node.
std::uint64_t Search::key_of(const SearchNode& n) const {
  const Vec2 p = n.state.position_m - request.start.position_m;
  std::uint64_t key = static_cast<std::uint64_t>(n.step) * table.size() + index_of(n.intention);
  key = key << 12 | quantised(p.x(), 0.05);
  key = key << 12 | quantised(p.y(), 0.05);
  key = key << 12 | quantised(n.state.velocity_m_s.x(), 0.05);
  key = key << 12 | quantised(n.state.velocity_m_s.y(), 0.05);
  return key;
}

bool Search::is_better_than_seen(const SearchNode& n) {
  const std::uint64_t key = key_of(n);
  const std::size_t mask = w.seen.size() - 1;
  std::size_t slot = (key * 0x9E3779B97F4A7C15ULL >> 20) & mask;
  while (w.seen[slot].search == w.search && w.seen[slot].key != key) slot = (slot + 1) & mask;
  auto& seen = w.seen[slot];
  if (seen.search == w.search && seen.cost <= n.cost + 1e-9) return false;
  seen = {key, n.cost, w.search};
  return true;
}

// Cheapest first; among equals the one that is further, then the one that was made first.
bool is_worse(const SearchWorkspace::Open& a, const SearchWorkspace::Open& b) {
  if (a.estimate != b.estimate) return a.estimate > b.estimate;
  return a.step != b.step ? a.step < b.step : a.node > b.node;
}

void Search::push(const SearchNode& n) {
  const double estimate = n.cost + heuristic(n);
  if (estimate > params.max_cost || !is_better_than_seen(n)) return;
  w.nodes.push_back(n);
  w.open.push_back({estimate, static_cast<std::int32_t>(w.nodes.size() - 1), n.step});
  std::push_heap(w.open.begin(), w.open.end(), is_worse);
}

// The turn of the root intention is one manoeuvre: wait straight on for room, turn, and only then
// whatever comes.
bool Search::is_allowed_before_turn(const SearchNode& from, const SearchNode& to) const {
  if (to.intention == request.root) return true;
  const bool has_begun = root_side * from.turned_rad > 0.0;
  if (has_begun && slows(to.intention)) return way_from_course_m(from) >= params.min_turn_way_m;
  if (has_begun) return root_side * from.turned_rad >= params.min_turn_rad - half_turn_rad();
  const double most_rad = std::abs(root_model().rate) * remaining_s(to.step);
  return to.intention == kOn && most_rad >= params.min_turn_rad;
}

bool Search::is_allowed(const SearchNode& from, const SearchNode& to) const {
  if (root_side != 0.0 && !is_allowed_before_turn(from, to)) return false;
  if (!turns(to.intention)) return true;
  if (root_side == 0.0) return std::abs(to.turned_rad) <= params.max_turn_rad + half_turn_rad();
  const bool resumed = from.intention != request.root && from.turned_rad != 0.0;
  return to.intention == request.root && !resumed &&
         std::abs(to.turned_rad) <= turn_limit_rad + half_turn_rad();
}

// A turn that ends at a wall beside the way is none: it must lead away from the present course.
bool Search::can_still_leave(const SearchNode& n) const {
  if (root_side == 0.0) return true;
  const double most_m = n.state.velocity_m_s.norm() * remaining_s(n.step);
  return way_from_course_m(n) + most_m >= params.min_turn_way_m;
}

void Search::expand(std::int32_t index) {
  const SearchNode from = w.nodes[index];
  for (const IntentionRow& row : table) {
    const MotionModel& model = model_of(row.id);
    SearchNode n = from;
    n.parent = index;
    n.step = static_cast<std::int16_t>(from.step + 1);
    n.intention = row.id;
    n.cost += change_cost(from.intention, row.id);  // g
    if (turns(row.id)) n.turned_rad += model.rate * params.step_s;
    if (!is_allowed(from, n)) continue;
    if (!arc_is_free(map, request.height_m, model, from.state, params.step_s, from.clearance_m))
      continue;
    n.state = advance(model, from.state, params.step_s);
    const double here_m = clearance_at(map, request.height_m, n.state.position_m);
    n.clearance_m = std::min(params.target_radius_m, std::max(from.clearance_m, here_m));
    if (can_still_leave(n)) push(n);
  }
}

void Search::keep_path(std::int32_t leaf) {
  w.path.resize(static_cast<std::size_t>(steps));
  for (std::int32_t i = leaf; w.nodes[i].parent >= 0; i = w.nodes[i].parent)
    w.path[w.nodes[i].step - 1] = i;
}

// A start nearer to an obstacle than the target's radius is an error of the estimate: it may go on,
// but not deeper than it seems to be, give or take half a cell.
double start_clearance_m(double clearance_m, const GridMap& map, const PredictionParams& params) {
  if (clearance_m >= params.target_radius_m) return params.target_radius_m;
  return std::max(0.01, clearance_m - 0.5 * map.resolution_m);
}

SearchOutcome Search::run() {
  goal_m = free_end_m(request.start, 0.0, 0);
  SearchNode root;
  root.state = request.start;
  root.intention = request.root;
  root.clearance_m =
      start_clearance_m(clearance_at(map, request.height_m, request.start.position_m), map, params);
  push(root);
  SearchOutcome outcome;
  while (!w.open.empty()) {
    std::pop_heap(w.open.begin(), w.open.end(), is_worse);
    const auto best = w.open.back();
    w.open.pop_back();
    if (best.step == steps) {
      keep_path(best.node);
      outcome.status = SearchStatus::kFound;
      return outcome;
    }
    if (outcome.expansions == params.max_expansions) {
      outcome.status = SearchStatus::kExhausted;
      return outcome;
    }
    ++outcome.expansions;
    expand(best.node);
  }
  return outcome;
}

void prepare(SearchWorkspace& w, const PredictionParams& params, IntentionTable table) {
  const auto most = static_cast<std::size_t>(params.max_expansions) * table.size() + 1;
  std::size_t slots = 64;
  while (slots < 2 * most) slots *= 2;
  if (w.seen.size() != slots) {
    w.seen.assign(slots, {});
    w.nodes.reserve(most);
    w.open.reserve(most);
    w.search = 0;
  }
  w.nodes.clear();
  w.open.clear();
  w.path.clear();
  if (++w.search == 0) {  // the counter came round: old entries would look new
    w.seen.assign(slots, {});
    w.search = 1;
  }
}

}  // namespace

bool arc_is_free(const GridMap& map, double height_m, const MotionModel& model,
                 const PlanarState& start, double duration_s, double clearance_m) {
  const double speed = start.velocity_m_s.norm();
  const double least_step_m = 0.5 * map.resolution_m;
  double time_s = 0.0;
  while (true) {
    const PlanarState x = advance(model, start, time_s);
    const double room_m = clearance_at(map, height_m, x.position_m) - clearance_m;
    if (room_m < 0.0) return false;
    if (time_s >= duration_s) return true;
    // The grid's distance may be wrong by the cell that holds the point.
    const double safe_m = std::max(least_step_m, room_m - map.resolution_m);
    if (speed * (duration_s - time_s) <= safe_m && room_m >= map.resolution_m) return true;
    time_s = speed > 0.0 ? std::min(duration_s, time_s + safe_m / speed) : duration_s;
  }
}

SearchOutcome search_path(const SearchRequest& request, const GridMap& map,
                          const PredictionParams& params, SearchWorkspace& workspace,
                          IntentionTable table) {
  prepare(workspace, params, table);
  return Search(request, map, params, workspace, table).run();
}

}  // namespace foretrack
