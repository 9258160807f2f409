// SPDX-License-Identifier: Apache-2.0
// Three vehicles follow one person over DDS, each with processes of its own.
#include "core/simulator/fleet_scenario.hpp"
#include "services/files/config/load_scenario.hpp"
#include "services/launch/domain.hpp"
#include "services/operator/fleet_log.hpp"
#include "tests/system/program.hpp"

namespace foretrack {
namespace {

Scenario fleet_scenario() {
  ScenarioOverrides overrides;
  overrides.map = MapSource::kKnown;
  return load_scenario("fleet_blocks", overrides);
}

// At half speed, so that a busy machine keeps up.
class Fleet : public ::testing::Test {
 protected:
  Fleet() {
    const std::string id = std::to_string(domain_.id());
    const std::string out = (folder_.path / "out").string();
    for (std::size_t i = 0; i < scenario_.vehicles.size(); ++i)
      onboard_.push_back(std::make_unique<Program>(
          std::vector<std::string>{"onboard", "--vehicle", scenario_.vehicles[i].name,
                                   "--px4-namespace", px4_namespace_of(i), "--domain", id,
                                   "--use-sim-time", "--no-mapping", "--state-dir",
                                   (folder_.path / "state").string()},
          out + scenario_.vehicles[i].name));
    simulator_ = std::make_unique<Program>(
        std::vector<std::string>{"simulator", "--scenario", "fleet_blocks", "--map", "known",
                                 "--domain", id, "--endless", "--people-wait", "60", "--speed",
                                 "0.5"},
        out);
    NodeOptions options;
    options.service = "test";
    options.domain_id = domain_.id();
    log_ = std::make_unique<FleetLog>(options, scenario_);
    for (const auto& vehicle : log_->vehicles()) {
      starts_.push_back(std::make_unique<OrderSender>(
          *vehicle->node, MissionCommand{.order = MissionOrder::kStart, .operator_name = "test"}));
      starts_.back()->insist();
    }
  }

  bool until(const std::function<bool()>& condition, double limit_s) {
    return eventually(
        [&] {
          log_->update();
          for (const auto& start : starts_) start->update();
          return condition();
        },
        limit_s);
  }
  double now_s() const { return log_->rows().empty() ? 0.0 : log_->rows().back().now_s; }
  bool all_walk_along() const {
    const auto& vehicles = log_->vehicles();
    return std::all_of(vehicles.begin(), vehicles.end(),
                       [](const auto& v) { return v->log->path_length_m() > 2.0; });
  }
  // Whoever would start its processes again goes first.
  void kill_vehicle(std::size_t vehicle) {
    const auto pids = processes_with({"--vehicle " + scenario_.vehicles[vehicle].name,
                                      "--domain " + std::to_string(domain_.id())});
    onboard_[vehicle]->send(SIGKILL);
    for (const pid_t pid : pids) kill(pid, SIGKILL);
  }
  double seen_share(double from_s, double to_s) const {
    int rows = 0, seen = 0;
    for (const FleetRow& row : log_->rows()) {
      if (row.now_s < from_s || row.now_s > to_s) continue;
      ++rows;
      seen += std::any_of(row.members.begin(), row.members.end(),
                          [](const FleetRowMember& m) { return m.sees; });
    }
    return rows > 0 ? static_cast<double>(seen) / rows : 0.0;
  }
  double least_separation_m() const {
    double least_m = 1e9;
    for (const FleetRow& row : log_->rows())
      for (std::size_t i = 0; i < row.members.size(); ++i)
        for (std::size_t k = 0; k < i; ++k)
          if (row.members[i].there && row.members[k].there)
            least_m = std::min(
                least_m,
                (row.members[i].position_enu_m - row.members[k].position_enu_m).norm() - 0.5);
    return least_m;
  }

  const FreeDomain domain_;
  const Scenario scenario_ = fleet_scenario();
  Folder folder_;
  std::vector<std::unique_ptr<Program>> onboard_;
  std::unique_ptr<Program> simulator_;
  std::unique_ptr<FleetLog> log_;
  std::vector<std::unique_ptr<OrderSender>> starts_;
};

TEST_F(Fleet, ThreeFollowAndGoOnWhenOneIsKilledInFlight) {
  ASSERT_TRUE(until([&] { return all_walk_along(); }, 120.0)) << onboard_.front()->output();
  const double together_s = now_s();
  ASSERT_TRUE(until([&] { return now_s() > together_s + 10.0; }, 60.0));
  const auto& vehicles = log_->vehicles();
  EXPECT_TRUE(until(
      [&] {
        return std::count_if(vehicles.begin(), vehicles.end(),
                             [](auto& v) { return v->is_near; }) == 1;
      },
      20.0))
      << "one keeps the band";
  EXPECT_GT(seen_share(together_s, now_s()), 0.75)
      << "rates are the bench's: these are ten seconds";

  kill_vehicle(1);
  const double killed_s = now_s();
  ASSERT_TRUE(until([&] { return now_s() > killed_s + 12.0; }, 60.0));
  EXPECT_FALSE(log_->rows().back().members[1].sees) << "nobody is on board";
  EXPECT_GT(seen_share(killed_s, now_s()), 0.6);
  EXPECT_GT(least_separation_m(), 0.0) << "hulls touched";
  for (const std::size_t survivor : {0, 2})
    EXPECT_LT(log_->rows().back().members[survivor].distance_m, 8.0)
        << log_->vehicles()[survivor]->name;
}

}  // namespace
}  // namespace foretrack
