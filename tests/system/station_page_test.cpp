// SPDX-License-Identifier: Apache-2.0
// The station's page in a browser, on a bus where somebody does not keep to the contract.
#include "services/common/node.hpp"
#include "services/common/raw.hpp"
#include "services/launch/domain.hpp"
#include "tests/system/station_program.hpp"

namespace foretrack {
namespace {

NodeOptions node_of(const FreeDomain& domain, const std::string& service) {
  NodeOptions options;
  options.service = service;
  options.domain_id = domain.id();
  return options;
}

bool bundle_page(const std::filesystem::path& to) {
  Program node({"node", kWeb + "/build.mjs", to.string()}, to.string() + ".out", "/usr/bin/env");
  return node.wait(60.0) == 0;
}

TEST(StationsPage, ListsAForeignTypeAndAQualityOfServiceThatDoesNotMatch) {
  if (!has_npm_packages()) GTEST_SKIP() << "npm ci was not run in " << kWeb;
  const FreeDomain domain;
  Folder folder;
  ASSERT_TRUE(bundle_page(folder.path / "page"));
  constexpr char kOdometry[] = "nav_msgs::msg::dds_::Odometry_";
  Node stranger(node_of(domain, "stranger")), strict(node_of(domain, "strict"));
  RawWriter foreign(stranger, {"rt/uav1/plan/path", "other::msg::dds_::Path_", false}, "state");
  RawWriter fit(stranger, {"rt/uav1/odometry", kOdometry, false}, "sensor");
  RawReader asks_for_more(strict, {"rt/uav1/odometry", kOdometry, false}, "state");
  RawWriter well(stranger,
                 {"rt/uav1/target/state", "foretrack_msgs::msg::dds_::TargetState_", false},
                 "state");
  Station station({"station", "--domain", std::to_string(domain.id()), "--page",
                   (folder.path / "page").string()},
                  folder.path);
  const auto page = "http://127.0.0.1:" + std::to_string(station.port()) + "/";
  const Json found = probe("page_topics.mjs", {page});
  if (found.contains("skipped")) GTEST_SKIP() << found["skipped"];
  const auto row = [&](const char* topic) { return found["rows"].value(topic, ""); };
  EXPECT_NE(row("uav1/plan/path").find("other::msg::dds_::Path_"), std::string::npos) << found;
  EXPECT_NE(row("uav1/odometry").find("QoS mismatch"), std::string::npos) << found;
  const auto good = row("uav1/target/state");
  EXPECT_NE(good, "") << found;
  EXPECT_EQ(good.find("QoS"), std::string::npos) << good;
  EXPECT_EQ(good.find("foreign"), std::string::npos) << good;
  EXPECT_GE(found["alarms"].size(), 2u) << found;
}

}  // namespace
}  // namespace foretrack
