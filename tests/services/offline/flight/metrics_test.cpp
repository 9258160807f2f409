// SPDX-License-Identifier: Apache-2.0
#include "services/offline/flight/metrics.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <nlohmann/json.hpp>

#include "services/offline/flight/flight_truth.hpp"
#include "services/offline/flight/metrics_json.hpp"

namespace foretrack {
namespace {

constexpr double kStep_s = 0.01;

// A target that walks along x at 1.5 m/s, a vehicle 2 m behind that sees it.
std::vector<FlightRow> good_flight(double for_s) {
  std::vector<FlightRow> rows;
  for (int i = 1; i <= std::lround(for_s / kStep_s); ++i) {
    FlightRow r;
    r.now_s = i * kStep_s;
    r.target.position_enu_m = {1.5 * r.now_s, 0, 1.2};
    r.target.velocity_enu_m_s = {1.5, 0, 0};
    r.vehicle.position_enu_m = {1.5 * r.now_s - 2.0, 0, 1.5};
    r.vehicle.velocity_enu_m_s = {1.5, 0, 0};
    r.sight = {true, true};
    r.clearance_m = 1.0;
    r.estimate.status = TrackStatus::kTracking;
    r.estimate.stamp_s = r.now_s;
    r.beliefs[0].probability = 1.0;
    rows.push_back(r);
  }
  return rows;
}

void change(std::vector<FlightRow>& rows, double from_s, double to_s,
            const std::function<void(FlightRow&)>& edit) {
  for (auto& row : rows)
    if (row.now_s > from_s + 1e-9 && row.now_s <= to_s + 1e-9) edit(row);
}

// The target turns left by 90° from `at_s` on, within 0.5 s.
void turn_left(std::vector<FlightRow>& rows, double at_s) {
  change(rows, at_s, 1e9, [&](FlightRow& r) {
    const double yaw = kPi / 2.0 * std::min(1.0, (r.now_s - at_s) / 0.5);
    r.target.velocity_enu_m_s = {1.5 * std::cos(yaw), 1.5 * std::sin(yaw), 0.0};
  });
}

TEST(Metrics, AFlawlessFlightHasNoFailures) {
  const Metrics m = metrics_of(good_flight(10.0), {});
  EXPECT_NEAR(m.duration_s, 10.0, 1e-9);
  EXPECT_EQ(m.failure_rate, 0.0);
  EXPECT_EQ(m.band_share, 1.0);
  EXPECT_EQ(m.losses, 0);
  EXPECT_NEAR(m.min_distance_m, 2.0, 1e-9);
  EXPECT_EQ(m.collisions, 0);
  EXPECT_EQ(m.turns, 0);
  EXPECT_EQ(m.smoothness_m2_s5, 0.0);
  EXPECT_EQ(m.limit_violation_s, 0.0);
}

TEST(Metrics, FailureIsTheUnionOfItsThreeParts) {
  auto rows = good_flight(10.0);
  change(rows, 1.0, 2.0, [](FlightRow& r) { r.sight.in_view = false; });
  change(rows, 1.5, 3.0, [](FlightRow& r) { r.sight.unhidden = false; });
  change(rows, 5.0, 5.5, [](FlightRow& r) { r.vehicle.position_enu_m.x() += 1.2; });
  const Metrics m = metrics_of(rows, {});
  EXPECT_NEAR(m.fov_loss_rate, 0.10, 1e-9);
  EXPECT_NEAR(m.occlusion_rate, 0.15, 1e-9);
  EXPECT_NEAR(m.near_rate, 0.05, 1e-9);
  EXPECT_NEAR(m.failure_rate, 0.25, 1e-9);
  EXPECT_EQ(m.losses, 1);
  EXPECT_NEAR(m.longest_loss_s, 2.0, 1e-9);
  EXPECT_NEAR(m.min_distance_m, 0.8, 1e-9);
}

TEST(Metrics, DistanceErrorCountsOutsideTheBandOnly) {
  auto rows = good_flight(10.0);
  change(rows, 0.0, 2.0, [](FlightRow& r) { r.vehicle.position_enu_m.x() -= 1.0; });  // 3 m
  const Metrics m = metrics_of(rows, {});
  EXPECT_NEAR(m.distance_error_mean_m, 0.2 * 0.5, 1e-9);
  EXPECT_NEAR(m.distance_error_rms_m, std::sqrt(0.2 * 0.25), 1e-9);
  EXPECT_NEAR(m.distance_error_p95_m, 0.5, 1e-9);
  EXPECT_NEAR(m.band_share, 0.8, 1e-9);
  EXPECT_NEAR(m.mean_distance_m, 2.2, 1e-9);
}

TEST(Metrics, CollisionsCountContactsNotSteps) {
  auto rows = good_flight(10.0);
  for (const double at_s : {2.0, 4.0, 4.2})
    change(rows, at_s, at_s + 0.1, [](FlightRow& r) { r.clearance_m = 0.1; });
  const Metrics m = metrics_of(rows, {});
  EXPECT_EQ(m.collisions, 3);
  EXPECT_NEAR(m.contact_s, 0.3, 1e-9);
  EXPECT_EQ(m.min_clearance_m, 0.1);
}

TEST(Metrics, JerkAndLimitsAreMeasuredOnTheFlownMotion) {
  auto rows = good_flight(10.0);
  for (auto& r : rows) r.acceleration_enu_m_s2.x() = 0.4 * r.now_s;  // jerk 0.4
  change(rows, 3.0, 4.0, [](FlightRow& r) { r.vehicle.velocity_enu_m_s.x() = 3.5; });
  const Metrics m = metrics_of(rows, {});
  EXPECT_NEAR(m.smoothness_m2_s5, 0.16, 1e-6);
  EXPECT_NEAR(m.limit_violation_s, 1.0, 1e-9);
  EXPECT_EQ(m.max_speed_m_s, 3.5);
}

TEST(Metrics, ATurnIsFoundWhereTheHeadingBeginsToChange) {
  auto rows = good_flight(10.0);
  turn_left(rows, 4.0);
  const auto events = events_of(rows);
  ASSERT_EQ(events.size(), 1u);
  EXPECT_EQ(events[0].kind, Intention::kTurnLeft);
  EXPECT_NEAR(events[0].begin_s, 4.0, 0.011);
  EXPECT_NEAR(events[0].end_s, 4.5, 0.011);
  EXPECT_NEAR(events[0].turn_rad, kPi / 2.0, 0.05);
}

TEST(Metrics, ATurnFailsByLossOfSightNearnessOrCollision) {
  const auto successes_with = [](const std::function<void(std::vector<FlightRow>&)>& edit) {
    auto rows = good_flight(10.0);
    turn_left(rows, 4.0);
    edit(rows);
    return metrics_of(rows, {}).turn_successes;
  };
  const auto hide = [](double from_s, double to_s) {
    return [=](std::vector<FlightRow>& rows) {
      change(rows, from_s, to_s, [](FlightRow& r) { r.sight.unhidden = false; });
    };
  };
  EXPECT_EQ(successes_with([](auto&) {}), 1);
  EXPECT_EQ(successes_with(hide(5.0, 5.5)), 1);
  EXPECT_EQ(successes_with(hide(5.0, 5.6)), 0);
  EXPECT_EQ(successes_with(hide(1.0, 2.9)), 1) << "before the window of the turn";
  EXPECT_EQ(successes_with([](auto& rows) {
              change(rows, 5.0, 5.1, [](FlightRow& r) {
                r.vehicle.position_enu_m = r.target.position_enu_m + Vec3(1.1, 0, 0);
              });
            }),
            0);
  EXPECT_EQ(successes_with([](auto& rows) {
              change(rows, 5.0, 5.1, [](FlightRow& r) { r.clearance_m = 0.0; });
            }),
            0);
}

TEST(Metrics, ASuddenStopIsADeceleration) {
  auto rows = good_flight(10.0);
  change(rows, 6.0, 1e9, [](FlightRow& r) {
    r.target.velocity_enu_m_s.x() = std::max(0.0, 1.5 - 3.0 * (r.now_s - 6.0));
  });
  change(rows, 7.0, 7.4, [](FlightRow& r) { r.vehicle.position_enu_m.x() += 0.7; });
  const Metrics m = metrics_of(rows, {});
  EXPECT_EQ(m.decelerations, 1);
  EXPECT_NEAR(events_of(rows)[0].begin_s, 6.0, 0.011);
  EXPECT_NEAR(m.deceleration_min_distance_m, 1.3, 1e-9);
  EXPECT_NEAR(m.deceleration_below_band_s, 0.4, 1e-9);
}

TEST(Metrics, LeadAndFalseAlarmsAreThoseOfTheScores) {
  auto rows = good_flight(10.0);
  turn_left(rows, 4.0);
  const int left = index_of(Intention::kTurnLeft), right = index_of(Intention::kTurnRight);
  change(rows, 3.6, 4.5, [&](FlightRow& r) { r.beliefs[left].probability = 0.6; });
  change(rows, 7.0, 7.2, [&](FlightRow& r) { r.beliefs[right].probability = 0.7; });
  const Metrics m = metrics_of(rows, {});
  const IntentionReport report = score_intentions(rows, truth_of(rows)).report();
  EXPECT_EQ(m.foreseen, 1);
  EXPECT_NEAR(m.lead_time_median_s, 0.4, 0.1);
  EXPECT_NEAR(m.lead_time_median_s, report.turns.median_lead_s, 1e-12);
  EXPECT_NEAR(m.false_alarms_per_min, 60.0 / 8.0, 0.1);
  EXPECT_GT(m.brier, 0.0);
  EXPECT_NEAR(m.brier_base, report.base_brier, 1e-12);
}

TEST(Metrics, ForesightIsComparedWithWhereTheTargetCameToBe) {
  auto rows = good_flight(10.0);
  for (auto& r : rows) {
    r.planned = true;
    for (std::size_t k = 0; k < kForesight_s.size(); ++k)
      r.foresight_m[k] = r.target.position_enu_m.head<2>() + Vec2(1.5 * kForesight_s[k], 0.1 * k);
  }
  const Metrics m = metrics_of(rows, {});
  for (std::size_t k = 0; k < kForesight_s.size(); ++k)
    EXPECT_NEAR(m.foresight_error_m[k], 0.1 * k, 1e-6);
}

TEST(Metrics, QuantilesAreByTheNearestRank) {
  std::vector<double> values;
  for (int i = 100; i >= 1; --i) values.push_back(i);
  const Quantiles q = quantiles_of(values);
  EXPECT_EQ(q.p50, 50.0);
  EXPECT_EQ(q.p95, 95.0);
  EXPECT_EQ(q.p99, 99.0);
  EXPECT_EQ(q.max, 100.0);
  EXPECT_EQ(quantiles_of({}).max, 0.0);
}

TEST(Metrics, WilsonIntervalsAreThosePublished) {
  // 8 of 10 and 3 of 10: 49–94 % and 11–60 %.
  EXPECT_NEAR(wilson(8, 10).low, 0.490, 0.001);
  EXPECT_NEAR(wilson(8, 10).high, 0.943, 0.001);
  EXPECT_NEAR(wilson(3, 10).low, 0.108, 0.001);
  EXPECT_NEAR(wilson(3, 10).high, 0.603, 0.001);
  EXPECT_EQ(wilson(0, 0).high, 1.0);
}

TEST(Metrics, JsonHoldsTheNumbersAndNullForInfinity) {
  auto rows = good_flight(3.0);
  for (auto& r : rows) r.clearance_m = std::numeric_limits<double>::infinity();
  const auto json = nlohmann::json::parse(json_of(metrics_of(rows, {}), "abc"));
  EXPECT_EQ(json["log_sha256"], "abc");
  EXPECT_EQ(json["failure_rate"], 0.0);
  EXPECT_TRUE(json["min_clearance_m"].is_null());
  EXPECT_TRUE(json["plan_ms"].contains("p99"));
}

TEST(FlightLog, HasOneLineForEachRowAndAsManyFieldsAsNames) {
  const std::string log = csv_of(good_flight(1.0));
  const auto commas = [](std::string_view line) {
    return std::count(line.begin(), line.end(), ',');
  };
  std::size_t lines = 0, at = 0;
  long expected = -1;
  while (at < log.size()) {
    const std::size_t end = log.find('\n', at);
    const long n = commas(std::string_view(log).substr(at, end - at));
    if (expected < 0) expected = n;
    ASSERT_EQ(n, expected);
    ++lines;
    at = end + 1;
  }
  EXPECT_EQ(lines, 101u);
}

TEST(FlightLog, Sha256IsThatOfTheStandard) {
  EXPECT_EQ(sha256_of("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
}

}  // namespace
}  // namespace foretrack
