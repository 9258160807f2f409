// SPDX-License-Identifier: Apache-2.0
// One-way latency, losses and processor time between two processes, by topic class, under the QoS
// profiles that $FORETRACK_SHARE/qos/profiles.xml says. With a folder of identities
// (`foretrack security issue --vehicle uav1`) as its argument, over a secured bus.
#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <thread>
#include <vector>

#include "foretrack_msgs/msg/LocalMap.h"
#include "foretrack_msgs/msg/TargetState.h"
#include "sensor_msgs/msg/Image.h"
#include "services/common/loop.hpp"
#include "services/common/reader.hpp"
#include "services/common/topics.hpp"
#include "services/common/writer.hpp"
#include "services/launch/domain.hpp"

namespace foretrack {
namespace {

using Steady = std::chrono::steady_clock;

constexpr int kSamples = 200;

double now_s() {
  return std::chrono::duration<double>(Steady::now().time_since_epoch()).count();
}

double cpu_ms(int who) {
  rusage usage{};
  getrusage(who, &usage);
  const auto ms = [](const timeval& t) { return 1e3 * t.tv_sec + 1e-3 * t.tv_usec; };
  return ms(usage.ru_utime) + ms(usage.ru_stime);
}

std::string identities;  // empty: not secured

NodeOptions options(const std::string& service, int domain, Role role) {
  NodeOptions result;
  result.service = service;
  result.domain_id = domain;
  if (!identities.empty()) result.security = identities + '/' + name_of(role);
  return result;
}

// Who may write the topic on a vehicle.
Role writer_of(const TopicInfo& info) {
  for (const Role role : kRoles)
    if (info.writers.has(role)) return role;
  return Role::kVehicle;
}

template <class Topic>
void send(int domain, double period_s, const typename Topic::Type& prototype) {
  Node node(options("sender", domain, writer_of(Topic::info)));
  Writer<Topic> writer(node);
  writer.sample() = prototype;
  const double deadline = now_s() + 10.0;
  while (writer.readers() == 0 && now_s() < deadline) usleep(1000);
  usleep(200000);
  double next = now_s();
  for (int i = 0; i < kSamples; ++i, next += period_s) {
    while (now_s() < next) usleep(100);
    writer.sample().header().stamp(to_stamp(now_s()));
    writer.write();
  }
  usleep(500000);
}

template <class Topic>
void receive(int domain, std::vector<double>& latencies_us) {
  Node node(options("receiver", domain, Role::kVehicle));
  Reader<Topic> reader(node);
  Stop stop;
  Loop loop(node, stop);
  loop.on_each(reader, [&](const auto& sample) {
    latencies_us.push_back(1e6 * (now_s() - to_seconds(sample.header().stamp())));
  });
  bool was_matched = false;
  loop.every(0.05, [&] {
    if (reader.writers() > 0) was_matched = true;
    if (was_matched && reader.writers() == 0) stop.request();
  });
  loop.run();
}

template <class Topic>
void measure(const char* name, double rate_hz, const typename Topic::Type& prototype) {
  const FreeDomain domain;
  fflush(stdout);
  const pid_t sender = fork();
  if (sender == 0) {
    send<Topic>(domain.id(), 1.0 / rate_hz, prototype);
    _exit(0);
  }
  const pid_t receiver = fork();
  if (receiver == 0) {
    const double before = cpu_ms(RUSAGE_SELF);
    std::vector<double> us;
    receive<Topic>(domain.id(), us);
    std::sort(us.begin(), us.end());
    const auto at = [&](double q) {
      return us.empty() ? 0.0 : us[std::size_t(q * (us.size() - 1))];
    };
    fmt::print(
        "{:<12} {:>5.0f} Hz  received {:>5.1f} %  p50 {:>7.0f} us  p95 {:>7.0f} us  "
        "receiver {:>5.0f} ms CPU",
        name, rate_hz, 100.0 * us.size() / kSamples, at(0.5), at(0.95),
        cpu_ms(RUSAGE_SELF) - before);
    fflush(stdout);
    _exit(0);
  }
  int status = 0;
  waitpid(receiver, &status, 0);
  rusage usage{};
  wait4(sender, &status, 0, &usage);
  fmt::print("  sender {:>5.0f} ms CPU\n",
             1e3 * (usage.ru_utime.tv_sec + usage.ru_stime.tv_sec) +
                 1e-3 * (usage.ru_utime.tv_usec + usage.ru_stime.tv_usec));
}

}  // namespace
}  // namespace foretrack

int main(int argc, char** argv) {
  using namespace foretrack;
  if (argc > 1) identities = argv[1];
  foretrack_msgs::msg::TargetState state;
  measure<topics::TargetState>("state", 100, state);

  sensor_msgs::msg::Image image;
  image.width(320), image.height(240), image.step(1280), image.encoding("32FC1");
  image.data().resize(1280 * 240);
  measure<topics::DepthImage>("image 0.3MB", 30, image);
  image.width(640), image.height(480), image.step(2560);
  image.data().resize(2560 * 480);
  measure<topics::DepthImage>("image 1.2MB", 30, image);

  foretrack_msgs::msg::LocalMap map;
  for (auto* cells : {&map.cells(), &map.occupied_distance_cm(), &map.unfree_distance_cm()})
    cells->resize(500000);
  measure<topics::LocalMap>("map 1.5MB", 10, map);
  for (auto* cells : {&map.cells(), &map.occupied_distance_cm(), &map.unfree_distance_cm()})
    cells->resize(2000000);
  measure<topics::LocalMap>("map 6MB", 10, map);
}
