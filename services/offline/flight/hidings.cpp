// SPDX-License-Identifier: Apache-2.0
#include "services/offline/flight/hidings.hpp"

#include <algorithm>
#include <cmath>

#include "core/common/moving_body.hpp"

namespace foretrack {
namespace {

constexpr double kFlightHeight_m = 1.3;
constexpr double kVehicleNeeds_m = 0.32;  // from its centre to walls, as plans have it
constexpr double kStep_m = 0.35;
constexpr double kLeastHidden_s = 2.0;
constexpr double kSteady_s = 0.5;
constexpr double kHull_m = 0.25, kPerson_m = 0.25;
constexpr double kNearTruth_m = 1.0;  // an estimate farther off is of somebody else

// Where the vehicle can fly to from its start, at the height of a person, cell by cell.
class Flyable {
 public:
  Flyable(const World& world, double resolution_m, const Vec3& start)
      : map_(known_map(world, resolution_m)),
        z_(map_.index_of({0.0, 0.0, world.min_m.z() + kFlightHeight_m}).z()),
        reached_(static_cast<std::size_t>(map_.size.x()) * map_.size.y(), 0) {
    Eigen::Vector3i first = map_.index_of(start);
    std::vector<Eigen::Vector2i> open = {first.head<2>()};
    while (!open.empty()) {
      const Eigen::Vector2i c = open.back();
      open.pop_back();
      for (const Eigen::Vector2i& move : {Eigen::Vector2i(1, 0), Eigen::Vector2i(-1, 0),
                                          Eigen::Vector2i(0, 1), Eigen::Vector2i(0, -1)}) {
        const Eigen::Vector2i to = c + move;
        if (!is_free(to) || reached_[offset(to)] != 0) continue;
        reached_[offset(to)] = 1;
        open.push_back(to);
      }
    }
  }

  bool is_near(const Vec3& person) const {
    const Eigen::Vector2i middle = map_.index_of(person).head<2>();
    const int reach = static_cast<int>(std::ceil(kStep_m / map_.resolution_m));
    for (int y = -reach; y <= reach; ++y)
      for (int x = -reach; x <= reach; ++x) {
        const Eigen::Vector2i c = middle + Eigen::Vector2i(x, y);
        if (!is_free(c) || reached_[offset(c)] == 0) continue;
        if (distance_xy(map_.center_of({c.x(), c.y(), z_}), person) <= kStep_m) return true;
      }
    return false;
  }

 private:
  std::size_t offset(const Eigen::Vector2i& c) const {
    return static_cast<std::size_t>(c.y()) * map_.size.x() + c.x();
  }
  bool is_free(const Eigen::Vector2i& c) const {
    const Eigen::Vector3i i(c.x(), c.y(), z_);
    return map_.contains(i) && 0.01 * map_.unfree_distance_cm[map_.offset_of(i)] >= kVehicleNeeds_m;
  }

  GridMap map_;
  int z_;
  std::vector<std::uint8_t> reached_;
};

bool is_found(const FlightRow& row) {
  return row.estimate.status == TrackStatus::kTracking && row.sight.visible() &&
         distance_xy(row.estimate.position_enu_m, row.target.position_enu_m) < kNearTruth_m;
}

double gap_of(const FlightRow& row) {
  const PersonTruth person = row.followed();
  return gap_m(row.vehicle.position_enu_m, kHull_m, person.foot_enu_m, kPerson_m, person.height_m);
}

// The first time from row i on from which they are found for a while.
double found_from(std::span<const FlightRow> rows, std::size_t i) {
  double since_s = std::numeric_limits<double>::infinity();
  for (; i < rows.size(); ++i) {
    if (!is_found(rows[i])) {
      since_s = std::numeric_limits<double>::infinity();
      continue;
    }
    since_s = std::min(since_s, rows[i].now_s);
    if (rows[i].now_s - since_s >= kSteady_s) return since_s;
  }
  return std::numeric_limits<double>::infinity();
}

}  // namespace

std::vector<HidingRecord> hidings_of(std::span<const FlightRow> rows, const World& world,
                                     double map_resolution_m) {
  std::vector<HidingRecord> records;
  if (rows.empty()) return records;
  const Flyable flyable(world, map_resolution_m, rows.front().vehicle.position_enu_m);
  double begin_s = -1.0, gap_m = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const double now_s = rows[i].now_s;
    if (!flyable.is_near(rows[i].target.position_enu_m)) {
      if (begin_s < 0.0) begin_s = now_s;
      gap_m = std::min(gap_m, gap_of(rows[i]));
      continue;
    }
    if (begin_s >= 0.0 && now_s - begin_s >= kLeastHidden_s &&
        now_s + kFindWithin_s <= rows.back().now_s + 1e-6) {
      HidingRecord& r = records.emplace_back();
      r.begin_s = begin_s;
      r.reappears_s = now_s;
      r.found_s = found_from(rows, i);
      for (std::size_t k = i; k < rows.size(); ++k) gap_m = std::min(gap_m, gap_of(rows[k]));
      r.least_gap_m = gap_m;
    }
    begin_s = -1.0;
    gap_m = std::numeric_limits<double>::infinity();
  }
  return records;
}

}  // namespace foretrack
