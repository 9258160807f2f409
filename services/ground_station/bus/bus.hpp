// SPDX-License-Identifier: Apache-2.0
// The DDS side: follows discovery, reads every topic as bytes, counts what comes.
#pragma once

#include <atomic>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "services/common/node.hpp"
#include "services/common/rate.hpp"
#include "services/common/raw.hpp"
#include "services/ground_station/bus/hearing.hpp"
#include "services/ground_station/bus/source.hpp"
#include "services/ground_station/bus/survey.hpp"

namespace foretrack::station {

/// A channel opens when a topic has a writer and closes 10 s after its last writer left, so that a
/// service that restarts keeps its channel. A topic of more than 1 MB/s that nobody wants rests,
/// and so do the pictures for the ground, which vehicles encode only while they are read. The bus
/// is joined anew, with a participant that nobody knows, in two cases: a peer lives but is no
/// longer heard, or the process stood still for so long that peers may have dropped it. Channels
/// stay.
class Bus : public Source {
 public:
  /// The outlet is called in run()'s thread.
  Bus(std::shared_ptr<Node> node, Outlet outlet);
  ~Bus() override;

  void run(Stop& stop) override;

  void want(std::set<std::uint32_t> channels) override;
  /// The station itself writes this topic (name on the wire), so it is read though discovery tells
  /// of no writer. From any thread.
  void expect_own(const std::string& wire);
  /// Joins the bus anew, unless it did so lately. From any thread.
  void ask_to_rejoin(const std::string& why);
  std::vector<TopicReport> topics() const override;
  std::vector<VehicleReport> vehicles() const override;
  std::vector<std::string> warnings() const override;

  /// Called in run()'s thread with the new node: what else has endpoints of the old one moves over.
  std::function<void(std::shared_ptr<Node>)> on_rejoin;

 private:
  struct Topic {
    Channel channel;
    SurveyedTopic found;
    std::unique_ptr<RawReader> reader;
    std::uint64_t samples = 0, bytes = 0;
    RateMeter sample_meter, byte_meter;
    double rate_hz = 0.0, bytes_s = 0.0;
    double opened_s = 0.0;  // the reader
    double last_s = -1.0;   // sample
    double alone_s = -1.0;  // since when nobody writes
    bool tells_clock = false;
    std::optional<double> ahead_s;  // its writer's clock
    bool open = false, resting = false, refused = false;
  };
  void look(double now_s);
  void update(const std::string& name, Topic& topic, double now_s);
  void open(const std::string& name, Topic& topic, double now_s);
  void close(Topic& topic);
  void measure(Topic& topic, double now_s);
  void stop_reading(Topic& topic);
  void take(double now_s);
  void publish(double now_s);
  void heal(double now_s);
  std::string reason_to_rejoin(double now_s);
  void rejoin();

  std::shared_ptr<Node> node_;
  Outlet outlet_;
  RawWait wait_;
  std::map<std::string, Topic> topics_;  // by name on the wire
  std::uint64_t discoveries_ = 0;
  std::uint32_t next_id_ = 1;
  std::shared_ptr<Bytes> spare_;
  std::vector<Sample> batch_;
  std::set<std::uint32_t> wanted_now_;
  Hearing hearing_;
  double round_s_ = -1.0;       // of the last round, by the clock that goes on in standby
  double stood_still_s_ = 0.0;  // for which nothing was done yet
  double rejoined_s_ = -1e9;

  std::atomic<bool> look_soon_ = false;

  mutable std::mutex mutex_;  // guards what follows
  std::set<std::uint32_t> wanted_;
  std::set<std::string> own_;
  std::string asked_to_rejoin_;  // why; empty: nobody did
  std::vector<TopicReport> topic_reports_;
  std::vector<VehicleReport> vehicle_reports_;
  std::vector<std::string> warnings_;
};

}  // namespace foretrack::station
