// The DDS side: follows discovery, reads every topic as bytes, counts what comes.
#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <vector>

#include "services/common/node.hpp"
#include "services/common/rate.hpp"
#include "services/common/raw.hpp"
#include "services/common/stop.hpp"
#include "services/ground_station/bus/channel.hpp"
#include "services/ground_station/bus/survey.hpp"

namespace foretrack::station {

/// One topic as operators see it.
struct TopicReport {
  std::uint32_t channel = 0;  // 0: there is none, as nobody writes it
  std::string topic, type, vehicle;
  int writers = 0, readers = 0;
  double rate_hz = 0.0, bytes_s = 0.0;
  double age_s = -1.0;   // since the last sample; negative: none yet
  bool resting = false;  // large, and nobody wants it: rates are the last known
  bool qos_mismatch = false;
  std::string foreign_type;
};

struct VehicleReport {
  std::string name;
  double seen_s_ago = -1.0;  // since any sample; negative: none yet
};

/// A channel opens when a topic has a writer and closes 10 s after its last writer left, so that a
/// service that restarts keeps its channel. A topic of more than 1 MB/s that nobody wants rests.
class Bus {
 public:
  /// The outlet is called in run()'s thread.
  Bus(Node& node, Outlet outlet);
  ~Bus();

  void run(Stop& stop);

  /// The channels that somebody reads or records. From any thread.
  void want(std::set<std::uint32_t> channels);
  std::vector<TopicReport> topics() const;
  std::vector<VehicleReport> vehicles() const;

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

  Node& node_;
  Outlet outlet_;
  RawWait wait_;
  std::map<std::string, Topic> topics_;  // by name on the wire
  std::uint64_t discoveries_ = 0;
  std::uint32_t next_id_ = 1;
  std::shared_ptr<Bytes> spare_;
  std::vector<Sample> batch_;

  mutable std::mutex mutex_;  // guards what follows
  std::set<std::uint32_t> wanted_;
  std::vector<TopicReport> topic_reports_;
  std::vector<VehicleReport> vehicle_reports_;
};

}  // namespace foretrack::station
