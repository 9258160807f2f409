// SPDX-License-Identifier: Apache-2.0
#include "bench/prediction/passages.hpp"

#include "core/common/random.hpp"

namespace foretrack::bench {
namespace {

constexpr int kNodes = 8;  // per side of the lattice
constexpr double kPitch_m = 5.0;
constexpr double kLane_m = 0.25;  // how far off the middle people walk
constexpr double kDecoy = 0.25;   // share of other passages that are open
constexpr std::array<std::array<int, 2>, 4> kSteps = {{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};

using Node = std::array<int, 2>;

class Maze {
 public:
  explicit Maze(std::uint64_t seed) : random_(seed), width_m_(random_.uniform(1.6, 3.0)) {}

  Passages build() {
    walk();
    open_decoys();
    Passages result;
    result.world = solid();
    for (const Node& n : route_) result.route_m.push_back(jittered(n));
    return result;
  }

 private:
  Vec2 center(const Node& n) const {
    return kPitch_m * Vec2(n[0] - 0.5 * (kNodes - 1), n[1] - 0.5 * (kNodes - 1));
  }
  // Both ends of a straight passage must be jittered alike, so the lane belongs to row and column.
  Vec2 jittered(const Node& n) {
    if (lanes_.empty())
      for (int i = 0; i < 2 * kNodes; ++i) lanes_.push_back(random_.uniform(-kLane_m, kLane_m));
    return center(n) + Vec2(lanes_[n[0]], lanes_[kNodes + n[1]]);
  }
  static bool inside(const Node& n) {
    return n[0] >= 0 && n[1] >= 0 && n[0] < kNodes && n[1] < kNodes;
  }
  bool& open(const Node& n, int axis) { return open_[axis][n[0]][n[1]]; }  // to the next node
  void open_between(const Node& a, int direction) {
    const auto& step = kSteps[direction];
    const Node low = step[0] + step[1] > 0 ? a : Node{a[0] + step[0], a[1] + step[1]};
    open(low, direction % 2) = true;
  }

  void walk() {
    Node here{random_.integer(0, kNodes - 1), random_.integer(0, kNodes - 1)};
    bool visited[kNodes][kNodes] = {};
    route_ = {here};
    while (true) {
      visited[here[0]][here[1]] = true;
      std::vector<int> choices;
      for (int d = 0; d < 4; ++d) {
        const Node next{here[0] + kSteps[d][0], here[1] + kSteps[d][1]};
        if (inside(next) && !visited[next[0]][next[1]]) choices.push_back(d);
      }
      if (choices.empty()) return;
      const int d = choices[random_.integer(0, static_cast<int>(choices.size()) - 1)];
      open_between(here, d);
      here = {here[0] + kSteps[d][0], here[1] + kSteps[d][1]};
      route_.push_back(here);
    }
  }
  void open_decoys() {
    for (auto& axis : open_)
      for (auto& column : axis)
        for (bool& is_open : column) is_open = is_open || random_.chance(kDecoy);
  }

  World solid() {
    World world;
    const double half_m = 0.5 * width_m_, wall_m = kPitch_m - width_m_;
    const auto add = [&](const Vec2& low, double x_m, double y_m) {
      world.boxes.push_back({Vec3(low.x(), low.y(), 0.0), Vec3(low.x() + x_m, low.y() + y_m, 4.0)});
    };
    for (int x = -1; x < kNodes; ++x)
      for (int y = -1; y < kNodes; ++y) {
        const Node n{x, y};
        const Vec2 c = center(n);
        add(c + Vec2(half_m, half_m), wall_m, wall_m);
        const bool in_x = x >= 0 && x + 1 < kNodes, in_y = y >= 0 && y + 1 < kNodes;
        if (y >= 0 && !(in_x && open(n, 0))) add(c + Vec2(half_m, -half_m), wall_m, width_m_);
        if (x >= 0 && !(in_y && open(n, 1))) add(c + Vec2(-half_m, half_m), width_m_, wall_m);
      }
    return world;
  }

  Random random_;
  double width_m_;
  std::vector<Node> route_;
  std::vector<double> lanes_;
  bool open_[2][kNodes][kNodes] = {};
};

}  // namespace

Passages generate_passages(std::uint64_t seed) {
  // Short walks end in a corner of the lattice: take the next seed.
  for (std::uint64_t s = seed * 1000;; ++s) {
    Passages passages = Maze(s).build();
    if (passages.route_m.size() >= 12) return passages;
  }
}

}  // namespace foretrack::bench
