// SPDX-License-Identifier: Apache-2.0
#include "services/offline/flight/fly_fleet.hpp"

#include <algorithm>

#include "core/simulator/fleet_failures.hpp"
#include "core/simulator/fleet_starts.hpp"
#include "core/simulator/radio_link.hpp"
#include "services/offline/people/load_person.hpp"

namespace foretrack {
namespace {

constexpr std::uint64_t kLinkPart = 7;  // of the scenario's seed

// One vehicle: its own view of the shared world, its tracker, and what is on the way to it.
struct Flyer {
  std::string name;
  SimulatorState simulator;
  TrackerPilot tracker;
  FlightResult result;
  AutopilotInput command;
  Inbox<FleetMember> inbox;
  std::vector<FleetMember> heard;
  Presence presence;
  int seat = -1;
  bool is_near = false;
};

class FlyingFleet {
 public:
  FlyingFleet(const Scenario& scenario, const TrackerParams& params, const FlightOptions& options)
      : scenario_(scenario),
        params_(params),
        options_(options),
        random_(seed_of(scenario, kLinkPart)) {
    const World world = world_of(scenario);
    const Person person =
        make_person(scenario.target.person, walk_of(scenario, world), world.min_m.z());
    const std::vector<Vec3> starts = fleet_starts(scenario, world, person);
    if (scenario.map == MapSource::kKnown) known_ = known_map(world, scenario.map_resolution_m);
    flyers_.reserve(scenario.vehicles.size());
    for (std::size_t i = 0; i < scenario.vehicles.size(); ++i) {
      const Scenario one = scenario_of(scenario, i, starts[i], person);
      flyers_.push_back(
          {.name = scenario.vehicles[i].name,
           .simulator = make_simulator(one, person_of(one), bystanders_of(one)),
           .tracker = TrackerPilot(one, params),
           .result = {.scenario = one, .world = world, .rows = {}, .metrics = {}, .plan_ms = {}},
           .command = {},
           .inbox = {},
           .heard = {},
           .presence = {}});
    }
  }

  FleetFlight run() {
    const auto steps = static_cast<int>(std::lround(scenario_.duration_s / options_.step_s));
    for (int i = 0; i < steps; ++i) {
      advance();
      if (options_.progress && !options_.progress(now_s_)) break;
    }
    return finish();
  }

 private:
  void find_peers(Flyer& f) const {
    f.simulator.peers_enu_m.clear();
    for (const Flyer& other : flyers_)
      if (&other != &f && other.presence.is_there())
        f.simulator.peers_enu_m.push_back(other.simulator.quadrotor.vehicle.position_enu_m);
  }

  void advance() {
    for (Flyer& f : flyers_) {
      find_peers(f);
      f.presence.update(scenario_, f.name, now_s_, f.simulator.quadrotor.vehicle.position_enu_m,
                        f.simulator.person.state.position_enu_m, f.simulator.peers_enu_m);
    }
    for (Flyer& f : flyers_) {
      find_peers(f);
      f.simulator.blind = now_s_ >= failure_s(scenario_, f.name, FleetFailureKind::kBlind);
      simulate(f.simulator, f.command, options_.step_s);
    }
    now_s_ = flyers_.front().simulator.output.now_s;
    rows_.push_back({.now_s = now_s_,
                     .person_enu_m = flyers_.front().simulator.output.target.position_enu_m,
                     .members = {}});
    for (Flyer& f : flyers_) decide(f);
    for (const Flyer& f : flyers_) rows_.back().members.push_back(member_of(f));
  }

  void decide(Flyer& f) {
    FlightRow& row = f.result.rows.emplace_back();
    write_truth(f.simulator, row);
    f.command = AutopilotInput{};
    f.heard.clear();
    f.inbox.deliver(now_s_, [&](const FleetMember& message) { f.heard.push_back(message); });
    if (!f.presence.is_there()) return;
    const FleetLink link{.vehicle = f.name, .frame = "map", .heard = f.heard};
    const double lands_s = failure_s(scenario_, f.name, FleetFailureKind::kLands);
    const bool lands = now_s_ >= lands_s && now_s_ < lands_s + options_.step_s;
    const MissionCommand land{.id = 2, .stamp_s = now_s_, .order = MissionOrder::kLand};
    const TrackerOutput out = f.tracker.fly(
        {f.simulator.output, known_.empty() ? nullptr : &known_, f.command, row, f.result.plan_ms},
        &link, lands ? &land : nullptr);
    if (out.fleet) tell(f, *out.fleet);
  }

  void tell(Flyer& f, const FleetResult& fleet) {
    f.seat = fleet.place.seat.number;
    f.is_near = fleet.place.ring == SeatRing::kNear;
    rows_.back().told_bytes += bytes_of(fleet.message);
    for (Flyer& other : flyers_) {
      if (&other == &f) continue;
      const auto at_s = arrival_s(scenario_.link, f.name, other.name, now_s_, random_);
      if (at_s) other.inbox.add(*at_s, fleet.message);
    }
  }

  bool peer_hides(const Flyer& f, const FlightRow& row) const {
    if (!row.sight.in_view) return false;
    const auto& peers = f.simulator.peers_enu_m;
    return std::any_of(peers.begin(), peers.end(), [&](const Vec3& peer) {
      return hides(peer, row.vehicle.position_enu_m, row.target.position_enu_m);
    });
  }

  FleetRowMember member_of(const Flyer& f) const {
    const FlightRow& row = f.result.rows.back();
    const bool lands = now_s_ >= failure_s(scenario_, f.name, FleetFailureKind::kLands);
    const bool blind = now_s_ >= failure_s(scenario_, f.name, FleetFailureKind::kBlind);
    return {.there = f.presence.is_there() && !lands,
            .position_enu_m = row.vehicle.position_enu_m,
            .sees = row.sight.visible() && !blind,
            .peer_hides = peer_hides(f, row),
            .distance_m = row.distance_m(),
            .seat = f.seat,
            .is_near = f.is_near};
  }

  // What it does before it joins and after it died is nobody's flight.
  void keep_rows_there(Flyer& f) const {
    const double joined_s = f.presence.joined_s().value_or(1e18);
    const double dies_s = failure_s(scenario_, f.name, FleetFailureKind::kDies);
    std::erase_if(f.result.rows, [&](const FlightRow& row) {
      return row.now_s < joined_s || row.now_s >= dies_s;
    });
  }

  FleetFlight finish() {
    FleetFlight out;
    const MetricParams metrics = metric_params_of(params_);
    std::vector<TruthEvent> events;
    std::size_t longest = 0;
    for (Flyer& f : flyers_) {
      keep_rows_there(f);
      if (f.result.rows.size() > 1) f.result.metrics = metrics_of(f.result.rows, metrics);
      f.result.metrics.plan_ms = quantiles_of(f.result.plan_ms);
      if (f.result.rows.size() > longest) {  // who is there all the time knows every turn
        longest = f.result.rows.size();
        events.clear();
        for (const EventRecord& turn : f.result.metrics.turn_records) events.push_back(turn.event);
      }
      out.names.push_back(f.name);
      out.vehicles.push_back(std::move(f.result));
    }
    out.metrics = fleet_metrics_of(rows_, events, fleet_metric_params_of(metrics, params_.fleet));
    for (const FlightResult& one : out.vehicles) {
      out.metrics.wall_contacts += one.metrics.collisions;
      out.metrics.person_contacts += one.metrics.person_contacts;
    }
    out.rows = std::move(rows_);
    return out;
  }

  const Scenario& scenario_;
  const TrackerParams& params_;
  const FlightOptions& options_;
  Random random_;
  GridMap known_;
  std::vector<Flyer> flyers_;
  std::vector<FleetRow> rows_;
  double now_s_ = 0.0;
};

}  // namespace

double bytes_of(const FleetMember& m) {
  return 148.0 + 88.0 * m.plan.count + 192.0 * m.person_count +
         m.intention_count * (20.0 + kSeatCount);
}

FleetFlight fly_fleet(const Scenario& scenario, const TrackerParams& params,
                      const FlightOptions& options) {
  return FlyingFleet(scenario, params, options).run();
}

}  // namespace foretrack
