// SPDX-License-Identifier: Apache-2.0
#include "services/ground_station/recording/black_box.hpp"

#include <spdlog/spdlog.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>

#include "services/common/service.hpp"
#include "services/common/time_now.hpp"
#include "services/ground_station/bus/contract.hpp"
#include "services/ground_station/recording/keep_within.hpp"
#include "services/ground_station/recording/record_bus.hpp"
#include "services/ground_station/recording/recover.hpp"

namespace foretrack::station {
namespace {

constexpr double kTidyPeriod_s = 10.0;
constexpr std::uint64_t kLargestFile = 256u << 20;
constexpr double kBytesInGb = 1e9;

// What flies comes first. Where a unit forbids the calls, it has set them itself.
void take_least_priority() {
  constexpr int kOfProcess = 1, kIdleClass = 3 << 13;  // ioprio_set(2)
  ::setpriority(PRIO_PROCESS, 0, 19);
  ::syscall(SYS_ioprio_set, kOfProcess, 0, kIdleClass);
}

// A tool: it goes by this machine's time, and is no node of ROS 2's.
NodeOptions tool_options(ServiceOptions options) {
  options.use_sim_time = false;
  options.ros_distro.clear();
  return node_options("record", options);
}

RecorderOptions recorder_options(const ServiceOptions& o, const std::string& parameters) {
  RecorderOptions recorder;
  recorder.folder = black_box_folder(o);
  recorder.split_bytes =
      std::min(kLargestFile, static_cast<std::uint64_t>(o.record.limit_gb * kBytesInGb / 8.0));
  recorder.leave_out = [o](const Channel& channel) { return is_left_out(channel, o); };
  recorder.metadata = recording_metadata(parameters);
  recorder.metadata["foretrack"]["vehicle"] = o.names.vehicle;
  return recorder;
}

/// Keeps to the limits, and goes on after a recording that ended by itself.
class Keeper {
 public:
  Keeper(Recorder& recorder, const ServiceOptions& o)
      : recorder_(recorder),
        folder_(black_box_folder(o)),
        limits_{static_cast<std::uint64_t>(o.record.limit_gb * kBytesInGb), o.record.limit_days} {}

  void look() {
    if (steady_s() - tidied_s_ < kTidyPeriod_s) return;
    tidied_s_ = steady_s();
    const auto status = recorder_.status();
    keep_within(folder_, limits_, status ? status->file : "");
    if (status) return;
    spdlog::warn("record: {}", recorder_.fault());
    if (const auto fault = recorder_.start(); !fault.empty()) spdlog::warn("record: {}", fault);
  }

 private:
  Recorder& recorder_;
  std::filesystem::path folder_;
  KeepLimits limits_;
  double tidied_s_ = -kTidyPeriod_s;
};

}  // namespace

std::string black_box_folder(const ServiceOptions& options) {
  return options.record.folder.empty()
             ? options.state_folder + "/recordings/" + options.names.vehicle
             : options.record.folder;
}

bool is_left_out(const Channel& channel, const ServiceOptions& options) {
  const auto vehicle = vehicle_of(channel.wire);
  if (!vehicle.empty() && vehicle != options.names.vehicle) return true;
  constexpr std::string_view kPictures[] = {
      "sensor_msgs::msg::dds_::Image_", "sensor_msgs::msg::dds_::CompressedImage_",
      "foxglove_msgs::msg::dds_::CompressedVideo_",
      "foretrack_msgs::msg::dds_::TargetChoice_"};  // it shows who could be meant
  return !options.record.images &&
         std::find(std::begin(kPictures), std::end(kPictures), channel.type) != std::end(kPictures);
}

void run_black_box(const ServiceOptions& options, const std::string& parameters, Stop& stop) {
  take_least_priority();
  std::error_code error;
  std::filesystem::create_directories(black_box_folder(options), error);
  recover_recordings(black_box_folder(options));
  Recorder recorder(recorder_options(options, parameters));
  Keeper keeper(recorder, options);
  spdlog::info("record: keeps {} GB and {} days in {}", options.record.limit_gb,
               options.record.limit_days, black_box_folder(options));
  record_bus(std::make_shared<Node>(tool_options(options)), recorder, stop,
             [&keeper] { keeper.look(); });
}

}  // namespace foretrack::station
