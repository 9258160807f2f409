// SPDX-License-Identifier: Apache-2.0
// Plays a recording: to the hub as if it were live, or back onto the bus.
#pragma once

#include <filesystem>
#include <map>
#include <mutex>
#include <set>
#include <string>
#include <vector>

#include "services/common/node.hpp"
#include "services/common/rate.hpp"
#include "services/ground_station/bus/source.hpp"

namespace foretrack::station {

struct ReplayOptions {
  std::filesystem::path file;
  double speed = 1.0;
  bool again = false;  // from the beginning when it has ended
};

/// Throws std::runtime_error that names the file and why no message can be read from it: no MCAP,
/// nothing in it, cut within its first chunk.
void check_recording(const std::filesystem::path& file);

/// Samples keep their log times.
class Replay : public Source {
 public:
  /// Throws as check_recording does.
  Replay(const ReplayOptions& options, Outlet outlet);

  /// Returns at the stop; after the end, waits for it.
  void run(Stop& stop) override;
  void want(std::set<std::uint32_t>) override {}
  std::vector<TopicReport> topics() const override;
  std::vector<VehicleReport> vehicles() const override;
  /// Topics that were recorded with another version of their type.
  std::vector<std::string> warnings() const override;

 private:
  struct Flow {
    Channel channel;
    std::uint64_t samples = 0, bytes = 0;
    RateMeter sample_meter, byte_meter;
    double last_s = -1.0;
  };
  void play(Stop& stop);

  ReplayOptions options_;
  Outlet outlet_;
  mutable std::mutex mutex_;
  mutable std::map<std::uint32_t, Flow> flows_;
  std::set<std::string> warnings_;
};

struct ReplayOntoDds {
  ReplayOptions options;
  bool with_commands = false;  // also what moves vehicles: orders and setpoints
};

struct ReplayedOntoDds {
  std::uint64_t samples = 0;          // that were written
  std::vector<std::string> warnings;  // of topics of another version of their type
  std::string fault;                  // why the file ended before its end; empty: it did not
};

/// Writes the recording's samples to the topics that they came from, with the same bytes; those of
/// rosbag2 under ROS 2's names and with the quality of service that they had. Types that have got
/// more fields at their end since get zeros for them. Topics that were not on the bus, those whose
/// type is another one today, and those that move vehicles, are left out. Until the end or the
/// stop. Throws as check_recording does.
ReplayedOntoDds replay_onto_dds(const ReplayOntoDds& replay, Node& node, Stop& stop);

}  // namespace foretrack::station
