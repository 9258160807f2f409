// SPDX-License-Identifier: Apache-2.0
#include "services/operator/fleet_log.hpp"

#include <algorithm>

#include "core/simulator/fleet_failures.hpp"
#include "services/common/raw.hpp"
#include "services/convert/fleet_report.hpp"
#include "services/convert/geometry.hpp"

namespace foretrack {
namespace {

constexpr double kAlive_s = 1.0;   // the gate speaks twenty times a second
constexpr double kBehind_s = 0.3;  // rows are made so long after: all truth has come by then
constexpr double kSame_s = 1e-6;
constexpr double kWalks_m_s = 0.1;

NodeOptions named(NodeOptions options, const std::string& vehicle) {
  options.names.vehicle = vehicle;
  return options;
}

std::vector<std::unique_ptr<HeardVehicle>> hear_all(const NodeOptions& options,
                                                    const Scenario& scenario) {
  std::vector<std::unique_ptr<HeardVehicle>> vehicles;
  for (const FleetVehicle& vehicle : scenario.vehicles)
    vehicles.push_back(std::make_unique<HeardVehicle>(named(options, vehicle.name), scenario));
  return vehicles;
}

// The last row until then, if it is not an old one; null: there is none.
const FlightRow* row_at(const FlightLog& log, double time_s) {
  const double since_s = time_s - log.first_s() + kSame_s;
  const auto after = std::upper_bound(log.rows().begin(), log.rows().end(), since_s,
                                      [](double t, const FlightRow& row) { return t < row.now_s; });
  if (after == log.rows().begin()) return nullptr;
  const FlightRow& row = *std::prev(after);
  return since_s - row.now_s < kBehind_s ? &row : nullptr;
}

}  // namespace

HeardVehicle::HeardVehicle(const NodeOptions& options, const Scenario& scenario)
    : name(options.names.vehicle),
      node(std::make_unique<Node>(options)),
      listener(std::make_unique<Listener>(*node, false)),
      log(std::make_unique<FlightLog>(scenario)),
      division(std::make_unique<Reader<topics::FleetDivision>>(*node)) {
  log->attach(listener->hooks);
  listener->hooks.safety = [this, inner = listener->hooks.safety](const auto& state) {
    heard_s = seconds(state.header().stamp());
    inner(state);
  };
}

bool HeardVehicle::is_alive(double now_s) const {
  return now_s - heard_s < kAlive_s;
}

FleetLog::FleetLog(const NodeOptions& options, const Scenario& scenario)
    : scenario_(scenario),
      vehicles_(hear_all(options, scenario)),
      members_(*vehicles_.front()->node) {}

double FleetLog::newest_s() const {
  double newest_s = -1.0;
  for (const auto& vehicle : vehicles_)
    if (!vehicle->log->rows().empty())
      newest_s = std::max(newest_s, vehicle->log->first_s() + vehicle->log->rows().back().now_s);
  return newest_s;
}

void FleetLog::update() {
  for (const auto& vehicle : vehicles_) {
    vehicle->listener->update();
    vehicle->division->take_each_as(
        [](const foretrack_msgs::msg::FleetDivision& message) { return from_idl(message); },
        [&](const FleetReport& report) {
          vehicle->seat = report.place.seat.number;
          vehicle->is_near = !report.place.is_alone && report.place.ring == SeatRing::kNear;
        });
  }
  members_.take_each([this](const foretrack_msgs::msg::FleetMember& message) {
    told_bytes_ +=
        static_cast<double>(to_cdr(type_ops<foretrack_msgs::msg::FleetMember>(), &message).size());
  });
  const double newest_s = this->newest_s();
  if (newest_s < 0.0) return;
  if (first_s_ < 0.0) first_s_ = next_s_ = newest_s;
  for (; next_s_ < newest_s - kBehind_s; next_s_ += FlightLog::kStep_s) add_row(next_s_);
}

void FleetLog::add_row(double time_s) {
  FleetRow row{.now_s = time_s - first_s_, .person_enu_m = Vec3::Zero(), .members = {}};
  for (const auto& vehicle : vehicles_) {
    const FlightRow* one = row_at(*vehicle->log, time_s);
    row.members.push_back(one ? member_at(*vehicle, time_s, *one) : FleetRowMember{.there = false});
    if (!one) continue;
    row.person_enu_m = one->target.position_enu_m;
    if (one->target.velocity_enu_m_s.norm() > kWalks_m_s) set_off_s_ = std::min(set_off_s_, time_s);
  }
  for (std::size_t i = 0; i < row.members.size(); ++i) {
    if (!row.members[i].there) continue;
    for (std::size_t k = 0; k < row.members.size(); ++k)
      if (k != i && row.members[k].there &&
          hides(row.members[k].position_enu_m, row.members[i].position_enu_m, row.person_enu_m))
        row.members[i].peer_hides = true;
  }
  row.told_bytes = std::exchange(told_bytes_, 0.0);
  rows_.push_back(std::move(row));
}

// Who flies on without anybody on board sees nobody, and is still in the others' way.
FleetRowMember FleetLog::member_at(const HeardVehicle& vehicle, double time_s,
                                   const FlightRow& row) const {
  const bool blind =
      time_s - set_off_s_ >= failure_s(scenario_, vehicle.name, FleetFailureKind::kBlind);
  return {.there = true,
          .position_enu_m = row.vehicle.position_enu_m,
          .sees = row.sight.visible() && !blind && vehicle.is_alive(time_s),
          .peer_hides = false,
          .distance_m = row.distance_m(),
          .seat = vehicle.seat,
          .is_near = vehicle.is_near};
}

FleetFlight FleetLog::flight(const MetricParams& metrics, const FleetParams& params) const {
  FleetFlight out;
  const World world = world_of(scenario_);
  std::vector<TruthEvent> events;
  for (const auto& vehicle : vehicles_) {
    FlightResult one{.scenario = scenario_,
                     .world = world,
                     .rows = vehicle->log->rows(),
                     .metrics = {},
                     .plan_ms = {}};
    if (one.rows.size() > 1) one.metrics = metrics_of(one.rows, metrics);
    const auto plans = vehicle->log->stage_ms().find("plan");
    if (plans != vehicle->log->stage_ms().end()) one.plan_ms = plans->second;
    one.metrics.plan_ms = quantiles_of(one.plan_ms);
    if (out.names.empty())
      for (const EventRecord& turn : one.metrics.turn_records) {
        events.push_back(turn.event);
        events.back().begin_s += vehicle->log->first_s() - first_s_;
        events.back().end_s += vehicle->log->first_s() - first_s_;
      }
    out.names.push_back(vehicle->name);
    out.vehicles.push_back(std::move(one));
  }
  if (rows_.size() > 1)
    out.metrics = fleet_metrics_of(rows_, events, fleet_metric_params_of(metrics, params));
  out.rows = rows_;
  return out;
}

}  // namespace foretrack
