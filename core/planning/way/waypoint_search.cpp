// SPDX-License-Identifier: Apache-2.0
#include "core/planning/way/waypoint_search.hpp"

#include <algorithm>
#include <array>

#include "core/planning/way/map_rays.hpp"

namespace foretrack {
namespace {

constexpr int kWindow = 256;                 // cells a side
constexpr double kNearBodyFactor = 8.0;      // cost of way through somebody, less towards the gap
constexpr double kNearby_m = 6.0;            // bodies farther from the target do not matter
constexpr double kLowClearanceFactor = 1.0;  // cost of way beside obstacles
constexpr double kGreed = 1.15;  // of the heuristic: fewer expansions for a slightly longer way

// One search. Nodes are cells of the window; the goal is a ring, so the distance to the ring is the
// heuristic (a lower bound: every metre of way costs at least 1).
class RingSearch {
 public:
  RingSearch(SearchState& state, const SearchContext& context, const Vec3& target, double time_s)
      : s_(state),
        map_(context.map),
        surface_(context.surface),
        target_(target),
        skip_m_(context.params.horizon.target_radius_m),
        wanted_m_(context.wanted_distance_m),
        tolerance_m_(context.ring_tolerance_m),
        body_(context.params.body),
        required_cm_(
            static_cast<int>(std::ceil(100.0 * context.params.path_clearance_m() - 1e-6))) {
    if (context.courses == nullptr) return;
    for (const BodyCourse& course : context.courses->all()) {
      if (time_s - context.start_s > course.horizon_s) continue;
      const Vec3 foot = course.body.expected_at(time_s);
      if (distance_xy(foot, target) > kNearby_m) continue;
      nearby_[nearby_count_++] = {foot, course.body.radius_m, course.body.height_m,
                                  course.probability};
    }
  }

  // True at a place on the ring that sees the target.
  bool is_goal(const Vec3& p) const {
    return to_ring_m(p.head<2>()) <= 0.0 && sees(map_, target_, p, skip_m_) && keeps_gaps(p);
  }

  // The node at which the search ended; `best` is the goal or what came nearest to the ring.
  WaypointKind run(const Vec3& from, int expansions_max, int& best) {
    const int start = node_of(from.head<2>());
    if (start < 0) return WaypointKind::kNone;
    ++s_.search;
    s_.open.clear();
    double best_m = to_ring_m(center_of(start));
    open_node(start, -1, 0.0F, clearance_cm(from), best_m);
    best = start;
    for (int i = 0; i < expansions_max && !s_.open.empty(); ++i) {
      const int n = pop();
      if (n < 0) continue;
      ++s_.expansions;
      const Vec2 xy = center_of(n);
      const double left_m = to_ring_m(xy);
      if (n != start && left_m <= 0.0 && is_goal(surface_.at(xy))) {
        best = n;
        return WaypointKind::kSees;
      }
      if (left_m < best_m) {
        best_m = left_m;
        best = n;
      }
      expand(n);
    }
    return best == start ? WaypointKind::kNone : WaypointKind::kNearest;
  }

  void append_path(int node, std::vector<Vec3>& path) const {
    const std::size_t first = path.size();
    for (int n = node; s_.nodes[n].parent >= 0; n = s_.nodes[n].parent)
      path.push_back(surface_.at(center_of(n)));
    std::reverse(path.begin() + static_cast<std::ptrdiff_t>(first), path.end());
  }

 private:
  int node_of(const Vec2& xy) const {
    const Eigen::Vector3i cell = map_.index_of({xy.x(), xy.y(), 0.0});
    const int x = cell.x() - s_.corner.x(), y = cell.y() - s_.corner.y();
    return x < 0 || y < 0 || x >= kWindow || y >= kWindow ? -1 : y * kWindow + x;
  }
  Vec2 center_of(int node) const {
    const Eigen::Vector2i cell = s_.corner + Eigen::Vector2i(node % kWindow, node / kWindow);
    return map_.origin_enu_m.head<2>() +
           map_.resolution_m * (cell.cast<double>() + Vec2::Constant(0.5));
  }
  double to_ring_m(const Vec2& xy) const {
    return std::max(0.0, std::abs((xy - target_.head<2>()).norm() - wanted_m_) - tolerance_m_);
  }
  std::uint8_t clearance_cm(const Vec3& p) const {
    const Eigen::Vector3i cell = map_.index_of(p);
    return map_.contains(cell) ? map_.unfree_distance_cm[map_.offset_of(cell)] : std::uint8_t{0};
  }

  void open_node(int node, int parent, float cost_m, std::uint8_t clearance, double left_m) {
    s_.nodes[node] = {s_.search, parent, cost_m, clearance, false};
    const double estimate_m = cost_m + kGreed * left_m;
    s_.open.push_back({static_cast<float>(estimate_m), node});
    std::push_heap(s_.open.begin(), s_.open.end());
  }

  // The cheapest open node, closed now; −1 for an entry that was overtaken.
  int pop() {
    std::pop_heap(s_.open.begin(), s_.open.end());
    const int node = s_.open.back().node;
    s_.open.pop_back();
    if (s_.nodes[node].closed) return -1;
    s_.nodes[node].closed = true;
    return node;
  }

  void expand(int from) {
    static constexpr std::array<std::array<int, 2>, 8> kMoves = {
        {{1, 0}, {-1, 0}, {0, 1}, {0, -1}, {1, 1}, {1, -1}, {-1, 1}, {-1, -1}}};
    const int x = from % kWindow, y = from / kWindow;
    for (std::size_t m = 0; m < kMoves.size(); ++m) {
      const int nx = x + kMoves[m][0], ny = y + kMoves[m][1];
      if (nx < 0 || ny < 0 || nx >= kWindow || ny >= kWindow) continue;
      // Between two corners that touch the diagonal, a corridor has no width.
      const bool diagonal = m >= 4;
      if (diagonal && !(may_enter(from, clearance_of(y * kWindow + nx)) &&
                        may_enter(from, clearance_of(ny * kWindow + x))))
        continue;
      relax(from, ny * kWindow + nx, map_.resolution_m * (diagonal ? 1.41421356 : 1.0));
    }
  }

  std::uint8_t clearance_of(int node) const {
    const SearchState::Node& known = s_.nodes[node];
    return known.search == s_.search ? known.clearance_cm
                                     : clearance_cm(surface_.at(center_of(node)));
  }
  // Once free, stay free; before that, do not come nearer.
  bool may_enter(int from, std::uint8_t clearance) const {
    return clearance >= std::min<int>(required_cm_, s_.nodes[from].clearance_cm);
  }

  void relax(int from, int to, double length_m) {
    const SearchState::Node parent = s_.nodes[from];
    const SearchState::Node& known = s_.nodes[to];
    const bool seen = known.search == s_.search;
    if (seen && known.closed) return;
    const std::uint8_t clearance = clearance_of(to);
    if (!may_enter(from, clearance)) return;
    const Vec2 xy = center_of(to);
    const double cost_m = parent.cost_m + length_m * cost_factor(xy, clearance);
    if (seen && cost_m >= known.cost_m) return;
    open_node(to, from, static_cast<float>(cost_m), clearance, to_ring_m(xy));
  }

  double cost_factor(const Vec2& xy, int clearance) const {
    const double low = std::max(0.0, 1.0 - clearance / (2.0 * required_cm_));
    return 1.0 + kLowClearanceFactor * low + kNearBodyFactor * nearness(surface_.at(xy));
  }

  struct Nearby {
    Vec3 foot;
    double radius_m, height_m, probability;
  };
  double gap_to(const Nearby& body, const Vec3& p) const {
    return gap_m(p, body_.hull_radius_m, body.foot, body.radius_m, body.height_m);
  }
  bool keeps_gaps(const Vec3& p) const {
    for (int i = 0; i < nearby_count_; ++i)
      if (gap_to(nearby_[i], p) < body_.gap_min_m) return false;
    return true;
  }
  // 0 from the wanted gap on, 1 where the hulls touch, and at most that.
  double nearness(const Vec3& p) const {
    double most = 0.0;
    for (int i = 0; i < nearby_count_; ++i) {
      const double missing = std::clamp(1.0 - gap_to(nearby_[i], p) / body_.gap_wanted_m, 0.0, 1.0);
      most = std::max(most, nearby_[i].probability * missing);
    }
    return most;
  }

  SearchState& s_;
  const GridMap& map_;
  const FlightSurface& surface_;
  const Vec3 target_;
  const double skip_m_, wanted_m_, tolerance_m_;
  const GapParams& body_;
  const int required_cm_;
  std::array<Nearby, BodyCourses::kCapacity> nearby_;
  int nearby_count_ = 0;
};

}  // namespace

void begin_searches(SearchState& state, const SearchContext& context, const Vec3& start_enu_m) {
  if (state.nodes.empty()) {
    state.nodes.resize(static_cast<std::size_t>(kWindow) * kWindow);
    state.open.reserve(state.nodes.size());
  }
  state.corner =
      context.map.index_of(start_enu_m).head<2>() - Eigen::Vector2i::Constant(kWindow / 2);
  state.expansions = 0;
}

WaypointKind search_waypoint(SearchState& state, const SearchContext& context, const Vec3& from,
                             const Vec3& target_enu_m, double time_s, int expansions_max,
                             std::vector<Vec3>& path) {
  RingSearch search(state, context, target_enu_m, time_s);
  if (search.is_goal(from)) return WaypointKind::kSees;
  int best = -1;
  const WaypointKind kind = search.run(from, expansions_max, best);
  if (kind != WaypointKind::kNone) search.append_path(best, path);
  return kind;
}

}  // namespace foretrack
