// SPDX-License-Identifier: Apache-2.0
#include "services/common/service.hpp"

#include <signal.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <thread>

#include "foretrack_msgs/msg/TargetState.h"
#include "rosgraph_msgs/msg/Clock.h"
#include "tests/services/common/bus.hpp"

namespace foretrack::testing {
namespace {

ServiceOptions service_options() {
  ServiceOptions options;
  options.domain_id = domain_id();
  return options;
}

// A service in a thread of its own, stopped at the end.
struct Running {
  Stop stop;
  Service service;
  std::thread thread;
  explicit Running(const std::string& name, const ServiceOptions& options = service_options())
      : service(name, options, stop) {}
  void start() {
    thread = std::thread([this] { service.run(); });
  }
  ~Running() {
    stop.request();
    if (thread.joinable()) thread.join();
  }
};

TEST(Service, CallsBackWithSamplesAndTimers) {
  Running running("perception");
  Reader<topics::TargetState> reader(running.service.node());
  std::atomic<int> samples = 0;
  std::atomic<int> ticks = 0;
  running.service.loop().on_newest(reader, [&](const auto&) { ++samples; });
  running.service.loop().every(0.01, [&] { ++ticks; });
  running.start();
  Node sender(node_options("sender"));
  Writer<topics::TargetState> writer(sender);
  ASSERT_TRUE(eventually([&] { return writer.readers() == 1; }));
  EXPECT_TRUE(eventually([&] {
    writer.write();
    return samples > 0 && ticks > 2;
  }));
}

TEST(Service, StopsAtOnceWhenAsked) {
  Running running("idle");
  running.start();
  running.stop.request();
  running.thread.join();
  EXPECT_TRUE(running.stop.requested());
}

TEST(Service, GoesOnAfterACallbackThrew) {
  Running running("faulty");
  std::atomic<int> calls = 0;
  running.service.loop().every(0.005, [&] {
    ++calls;
    throw std::runtime_error("bad luck");
  });
  running.start();
  EXPECT_TRUE(eventually([&] { return calls >= 3; }));
  EXPECT_NE(running.service.node().last_error().find("bad luck"), std::string::npos);
}

TEST(Service, PublishesItsHealth) {
  Running running("perception");
  Reader<topics::TargetState> reader(running.service.node());
  running.service.health().set_degraded("no camera");
  running.start();
  Node monitor(node_options("monitor"));
  Reader<topics::ServiceHealth> health(monitor);
  const foretrack_msgs::msg::ServiceHealth* got = nullptr;
  ASSERT_TRUE(eventually([&] { return (got = health.take_newest()) != nullptr; }));
  EXPECT_STREQ(got->service().c_str(), "perception");
  EXPECT_EQ(got->state(), foretrack_msgs::msg::ServiceHealth_Constants::STATE_DEGRADED);
  EXPECT_STREQ(got->last_error().c_str(), "no camera");
  EXPECT_GT(got->rss_bytes(), 1000000u);
  const auto& topics = got->topics();
  const auto of_reader = std::find_if(topics.begin(), topics.end(), [](const auto& t) {
    return t.topic() == "rt/uav1/target/state";
  });
  ASSERT_NE(of_reader, topics.end());
  EXPECT_FALSE(of_reader->writes());
  EXPECT_EQ(of_reader->age_s(), -1.0);
}

TEST(Service, FollowsSimulatedTime) {
  auto options = service_options();
  options.use_sim_time = true;
  Running running("planning", options);
  std::atomic<int> ticks = 0;
  std::atomic<double> now_s = -1.0;
  running.service.loop().every(0.1, [&] {
    ++ticks;
    now_s = running.service.clock().now_s();
  });
  Node simulator(node_options("simulator"));
  Writer<topics::Clock> clock(simulator);
  running.start();
  ASSERT_TRUE(eventually([&] { return clock.readers() == 1; }));
  const auto step_to = [&](double time_s) {
    return eventually([&] {
      clock.sample().clock(to_stamp(time_s));
      clock.write();
      return std::abs(now_s - time_s) < 1e-6;
    });
  };
  ASSERT_TRUE(step_to(5.0));
  const int before = ticks;
  ASSERT_TRUE(step_to(5.1));
  EXPECT_EQ(ticks, before + 1) << "one period of simulated time";
  EXPECT_TRUE(step_to(1.0)) << "a restarted simulator starts the timers again";
}

// In a process of its own, as every thread must be younger than the SignalStop.
TEST(SignalStop, TurnsASignalIntoAStop) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  const auto one_signal = [] {
    Stop stop;
    bool stopped = false;
    {
      SignalStop signals(stop);
      const bool early = stop.requested();
      kill(getpid(), SIGTERM);
      stopped = eventually([&] { return stop.requested(); }) && !early;
    }
    _exit(stopped ? 7 : 1);
  };
  EXPECT_EXIT(one_signal(), ::testing::ExitedWithCode(7), "");
}

TEST(SignalStop, TheSecondSignalEndsTheProcess) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  const auto two_signals = [] {
    Stop stop;
    SignalStop signals(stop);
    kill(getpid(), SIGINT);
    eventually([&] { return stop.requested(); });
    kill(getpid(), SIGINT);
    pause();
  };
  EXPECT_EXIT(two_signals(), ::testing::ExitedWithCode(128 + SIGINT), "");
}

TEST(Options, AreReadFromTheCommandLine) {
  CLI::App app;
  ServiceOptions options;
  add_options(app, options);
  app.parse("--vehicle uav7 --domain 42 --use-sim-time --px4-namespace px4_7");
  EXPECT_EQ(options.names.vehicle, "uav7");
  EXPECT_EQ(options.domain_id, 42);
  EXPECT_TRUE(options.use_sim_time);
  EXPECT_EQ(options.names.px4_namespace, "px4_7");
}

TEST(Options, RefuseADomainWithoutPorts) {
  CLI::App app;
  ServiceOptions options;
  add_options(app, options);
  EXPECT_THROW(app.parse("--domain 233"), CLI::ValidationError);
}

TEST(Time, RoundTripsToTheNanosecond) {
  for (const double time_s : {0.0, 1.5, 1784000000.25, 12.999999999}) {
    const auto stamp = to_stamp(time_s);
    EXPECT_LT(stamp.nanosec(), 1000000000u);
    EXPECT_NEAR(to_seconds(stamp), time_s, 1e-6);
  }
  EXPECT_EQ(to_stamp(12.9999999999).sec(), 13);
  EXPECT_THROW(to_stamp(-1.0), std::invalid_argument);
  EXPECT_THROW(to_stamp(std::nan("")), std::invalid_argument);
}

}  // namespace
}  // namespace foretrack::testing
