// SPDX-License-Identifier: Apache-2.0
#include "services/offline/experiments/run_record.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "services/offline/flight/flight_truth.hpp"

namespace foretrack {
namespace {

using Rows = std::span<const FlightRow>;

constexpr double kPassReach_m = 2.5;
constexpr double kSettled_s = 3.0;  // the beginning, when all stand, does not count in the map
constexpr int kPlaceEvery = 5, kViewEvery = 10;  // rows
constexpr double kChi2Of90 = 4.605170185988092;  // two degrees of freedom
constexpr double kLeastWalking_m_s = 0.3;

EventOutcome outcome_of(const EventRecord& r) {
  return {r.event.begin_s, r.success, r.min_distance_m, r.longest_loss_s, r.collided};
}

std::size_t row_at(Rows rows, double time_s) {
  const double step_s = rows[1].now_s - rows[0].now_s;
  const double index = std::round((time_s - rows[0].now_s) / step_s);
  return static_cast<std::size_t>(std::clamp(index, 0.0, static_cast<double>(rows.size() - 1)));
}

EventOutcome outcome_of_walk(const Metrics& m, const MetricParams& p) {
  const bool success = m.collisions == 0 && m.longest_loss_s <= p.turn_loss_s + 1e-9 &&
                       m.min_distance_m >= p.band_low_m - p.turn_distance_slack_m;
  return {0.0, success, m.min_distance_m, m.longest_loss_s, m.collisions > 0};
}

DistanceCurve curve_of(Rows rows, double begin_s) {
  DistanceCurve curve;
  const int count = static_cast<int>(std::lround((kCurveTo_s - kCurveFrom_s) / kCurveStep_s)) + 1;
  for (int i = 0; i < count; ++i) {
    const double t = begin_s + kCurveFrom_s + i * kCurveStep_s;
    const bool inside = t >= rows.front().now_s - 1e-9 && t <= rows.back().now_s + 1e-9;
    curve.push_back(inside ? static_cast<float>(rows[row_at(rows, t)].distance_m())
                           : std::numeric_limits<float>::quiet_NaN());
  }
  return curve;
}

void add_places(Rows rows, RelativePlaces& places) {
  for (std::size_t i = 0; i < rows.size(); i += kPlaceEvery) {
    const FlightRow& row = rows[i];
    if (row.now_s < kSettled_s) continue;
    const Vec2 offset = (row.target.position_enu_m - row.vehicle.position_enu_m).head<2>();
    const Vec2 ahead = direction_of(row.vehicle.yaw_rad());
    places.add({offset.dot(ahead), ahead.x() * offset.y() - ahead.y() * offset.x()});
  }
}

std::vector<ViewPoint> view_of(Rows rows) {
  std::vector<ViewPoint> view;
  const auto point = [](const Vec3& p) {
    return std::array{static_cast<float>(p.x()), static_cast<float>(p.y())};
  };
  for (std::size_t i = 0; i < rows.size(); i += kViewEvery)
    view.push_back({static_cast<float>(rows[i].now_s), point(rows[i].vehicle.position_enu_m),
                    point(rows[i].target.position_enu_m), rows[i].sight.visible()});
  return view;
}

double mean_walking_speed(Rows rows) {
  double sum = 0.0;
  int count = 0;
  for (const FlightRow& row : rows) {
    const double speed = row.target.velocity_enu_m_s.head<2>().norm();
    if (speed > kLeastWalking_m_s) sum += speed, ++count;
  }
  return count > 0 ? sum / count : 0.0;
}

}  // namespace

void RelativePlaces::add(const Vec2& p) {
  count += 1.0;
  x += p.x(), y += p.y();
  xx += p.x() * p.x(), xy += p.x() * p.y(), yy += p.y() * p.y();
  const int ix = static_cast<int>(std::floor((p.x() - kMinX_m) / kCell_m));
  const int iy = static_cast<int>(std::floor((p.y() - kMinY_m) / kCell_m));
  if (ix >= 0 && ix < kCells && iy >= 0 && iy < kCells) ++cells[iy * kCells + ix];
}

RelativePlaces& RelativePlaces::operator+=(const RelativePlaces& o) {
  for (std::size_t i = 0; i < cells.size(); ++i) cells[i] += o.cells[i];
  count += o.count;
  x += o.x, y += o.y;
  xx += o.xx, xy += o.xy, yy += o.yy;
  return *this;
}

double RelativePlaces::ellipse_area_m2() const {
  if (count < 2.0) return 0.0;
  const double mx = x / count, my = y / count;
  const double sxx = xx / count - mx * mx, sxy = xy / count - mx * my, syy = yy / count - my * my;
  return kPi * kChi2Of90 * std::sqrt(std::max(0.0, sxx * syy - sxy * sxy));
}

EventOutcome outcome_of(const EncounterRecord& e) {
  const bool success =
      !e.contact() && !e.wall_contact && e.least_gap_m >= gap_floor_m(e.person_speed_m_s);
  return {e.begin_s, success, e.least_gap_m, e.longest_loss_s, e.contact() || e.wall_contact};
}

EventOutcome outcome_of(const HidingRecord& h) {
  const bool contact = h.least_gap_m <= 0.0;
  return {h.reappears_s, h.found_within(kFindWithin_s) && !contact, h.least_gap_m,
          h.until_found_s(), contact};
}

bool RunRecord::failed() const {
  return metrics.collisions > 0 ||
         std::any_of(events.begin(), events.end(), [](const auto& e) { return !e.success; });
}

std::vector<EventOutcome> outcomes_of(const Metrics& m, Rows rows, EventKind kind,
                                      const MetricParams& params) {
  std::vector<EventOutcome> outcomes;
  if (kind == EventKind::kWalk) return {outcome_of_walk(m, params)};
  if (kind == EventKind::kEncounter || kind == EventKind::kHiding) return {};
  const auto& records = kind == EventKind::kDeceleration ? m.deceleration_records : m.turn_records;
  for (const EventRecord& r : records) {
    const Vec3& place = rows[row_at(rows, r.event.begin_s)].target.position_enu_m;
    if (kind == EventKind::kPass && place.head<2>().norm() > kPassReach_m) continue;
    outcomes.push_back(outcome_of(r));
  }
  return outcomes;
}

RunRecord record_of(const FlightResult& flight, std::string_view log_csv, const PathRecord& paths,
                    EventKind kind, const MetricParams& params) {
  const Rows rows = flight.rows;
  RunRecord record;
  record.log_sha256 = sha256_of(log_csv);
  record.metrics = flight.metrics;
  record.mean_speed_m_s = mean_walking_speed(rows);
  record.plan_ms = flight.plan_ms;
  record.events = outcomes_of(flight.metrics, rows, kind, params);
  if (kind == EventKind::kEncounter) {
    record.staged = flight.scenario.encounter;
    record.encounters = encounters_of(rows, params);
    record.longest_hover_s = longest_hover_s(rows, params);
    for (const EncounterRecord& e : record.encounters) record.events.push_back(outcome_of(e));
  } else if (kind == EventKind::kHiding) {
    record.hidings = hidings_of(rows, flight.world, flight.scenario.map_resolution_m);
    for (const HidingRecord& h : record.hidings) record.events.push_back(outcome_of(h));
  } else if (kind != EventKind::kWalk) {
    for (const EventOutcome& event : record.events)
      record.curves.push_back(curve_of(rows, event.begin_s));
  }
  add_places(rows, record.places);
  record.intentions = score_intentions(rows, truth_of(rows));
  record.paths = paths.scores(rows);
  record.view = view_of(rows);
  return record;
}

}  // namespace foretrack
