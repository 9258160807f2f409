// SPDX-License-Identifier: Apache-2.0
// foretrack station, record, replay: the ground station and its recordings.
#include <fmt/format.h>
#include <unistd.h>

#include <memory>
#include <utility>

#include "services/cli/bus_options.hpp"
#include "services/cli/commands.hpp"
#include "services/common/options.hpp"
#include "services/common/time_now.hpp"
#include "services/files/config/load_params.hpp"
#include "services/files/share/share.hpp"
#include "services/ground_station/recording/record_bus.hpp"
#include "services/ground_station/recording/recover.hpp"
#include "services/ground_station/recording/replay.hpp"
#include "services/ground_station/station.hpp"

namespace foretrack {
namespace {

using station::StationOptions;

struct StationArguments {
  StationOptions options;
  std::string page, params_file;
  std::string recordings = "recordings";
  std::string token_file = station::default_token_file();
  std::string audit_file = station::default_audit_file();
  double topic_limit_mb_s = 8.0;
  double client_budget_mb = 8.0;
  std::uint64_t split_mb = 1024;
};

struct RecordArguments {
  StationArguments shared;
  double for_s = 0.0;  // 0: until Ctrl-C
};

struct ReplayArguments {
  StationArguments shared;
  std::string file;
  double speed = 1.0;
  bool again = false, onto_dds = false, with_commands = false;
};

std::filesystem::path page_folder(const std::string& chosen) {
  if (!chosen.empty()) return chosen;
  for (const auto& folder : share_folders())
    for (const char* place : {"page", "services/ground_station/web/dist"})
      if (std::filesystem::exists(folder / place / "index.html")) return folder / place;
  return {};
}

void add_domain(CLI::App& app, StationArguments& arguments) {
  app.add_option("--domain", arguments.options.node.domain_id, "DDS domain")
      ->envname("ROS_DOMAIN_ID")
      ->check(CLI::Range(0, 232))
      ->capture_default_str();
  auto& node = arguments.options.node;
  add_network_options(app, node.interface, node.security);
  add_meeting_options(app, node.peers, node.discovery_server);
  add_ros_option(app, node.ros_distro);
}

void add_server_options(CLI::App& app, StationArguments& arguments) {
  auto& o = arguments.options;
  app.add_option("--address", o.server.address, "To listen on")->capture_default_str();
  app.add_option("--port", o.server.port, "To listen on; 0: a free one")->capture_default_str();
  app.add_option("--page", arguments.page, "Folder of the page")->check(CLI::ExistingDirectory);
  app.add_option(
      "--map", o.map,
      "Under the page's map: a folder of tiles, a PNG or JPEG whose place is known, or a "
      "GeoTIFF");
  app.add_option("--allow-host", o.more_hosts, "Also answer to this name:port");
  app.add_option("--allow-origin", o.more_origins,
                 "Also serve pages of this origin: https://app.foxglove.dev");
  app.add_option("--certificate", o.server.certificate_file, "TLS: chain of certificates (PEM)")
      ->check(CLI::ExistingFile);
  app.add_option("--key", o.server.key_file, "TLS: private key (PEM)")->check(CLI::ExistingFile);
  app.add_flag("--insecure-lan", o.insecure_lan,
               "Serve other machines without TLS: anybody on the way reads the token");
  app.add_option("--token-file", arguments.token_file, "Operators' tokens; made if missing")
      ->capture_default_str();
  app.add_option("--audit-file", arguments.audit_file, "Log of orders and refusals")
      ->capture_default_str();
  app.add_flag("--print-token", o.print_token, "Put the token into the address that is printed");
  app.add_option("--topic-limit", arguments.topic_limit_mb_s, "Of one topic to clients, MB/s")
      ->check(CLI::Range(0.001, 1e4))
      ->capture_default_str();
  app.add_option("--client-budget", arguments.client_budget_mb, "What may wait for a client, MB")
      ->check(CLI::Range(0.1, 1e4))
      ->capture_default_str();
  app.add_option("--max-clients", o.server.clients, "Clients at a time")->capture_default_str();
}

void add_recorder_options(CLI::App& app, StationArguments& arguments) {
  auto& o = arguments.options.recorder;
  app.add_option("--recordings", arguments.recordings, "Folder of the recordings")
      ->capture_default_str();
  app.add_option("--topics", o.topics, "Record only topics whose name contains one of these");
  app.add_option("--split", arguments.split_mb, "A new file after so many MB")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_option("--params", arguments.params_file, "Parameter file to keep in the recordings")
      ->check(CLI::ExistingFile);
}

StationOptions complete(const StationArguments& arguments) {
  StationOptions options = arguments.options;
  options.node.service = "station";
  options.page = page_folder(arguments.page);
  options.token_file = arguments.token_file;
  options.audit_file = arguments.audit_file;
  options.limits.topic_bytes_s = 1e6 * arguments.topic_limit_mb_s;
  options.limits.client_budget_bytes = static_cast<std::size_t>(1e6 * arguments.client_budget_mb);
  options.recorder.folder = arguments.recordings;
  options.recorder.split_bytes = arguments.split_mb << 20;
  TrackerParams params =
      arguments.params_file.empty() ? TrackerParams{} : load_params(arguments.params_file);
  options.recorder.metadata = station::recording_metadata(yaml_of_params(params));
  return options;
}

int run_record(const RecordArguments& arguments) {
  set_up_logging("warning");
  Stop stop;
  SignalStop signals(stop);
  StationOptions options = complete(arguments.shared);
  options.node.service = "record";
  station::recover_recordings(options.recorder.folder);
  station::Recorder recorder(options.recorder);
  const double begin_s = steady_s();
  bool told = false;
  station::record_bus(std::make_shared<Node>(options.node), recorder, stop, [&] {
    const auto status = recorder.status();
    if (status && !std::exchange(told, true)) {
      fmt::print("recording to {}; Ctrl-C ends it\n",
                 (options.recorder.folder / status->file).string());
      std::fflush(stdout);
    }
    const bool over = arguments.for_s > 0.0 && steady_s() - begin_s >= arguments.for_s;
    if (!status || over) stop.request();
  });
  if (!recorder.fault().empty()) throw std::runtime_error(recorder.fault());
  return 0;
}

int run_replay(const ReplayArguments& arguments) {
  set_up_logging("warning");
  Stop stop;
  SignalStop signals(stop);
  StationOptions options = complete(arguments.shared);
  const station::ReplayOptions replay{arguments.file, arguments.speed, arguments.again};
  if (!arguments.onto_dds) {
    options.replay = replay;
    run_station(options, stop);
    return 0;
  }
  options.node.service = "replay";
  Node node(options.node);
  const auto done = station::replay_onto_dds({replay, arguments.with_commands}, node, stop);
  for (const auto& text : done.warnings) fmt::print(stderr, "{}\n", text);
  fmt::print("{} samples written\n", done.samples);
  if (!done.fault.empty()) fmt::print(stderr, "{}: {}\n", arguments.file, done.fault);
  return 0;
}

}  // namespace

std::function<int()> prepare_station(CLI::App& app) {
  auto arguments = std::make_shared<StationArguments>();
  add_domain(app, *arguments);
  add_server_options(app, *arguments);
  add_recorder_options(app, *arguments);
  app.add_flag("--enable-control", arguments->options.enable_control,
               "Let operators with a token command vehicles");
  app.add_flag("--record", arguments->options.record, "Record from the beginning");
  return [arguments] {
    set_up_logging("warning");
    Stop stop;
    SignalStop signals(stop);
    run_station(complete(*arguments), stop);
    return 0;
  };
}

std::function<int()> prepare_record(CLI::App& app) {
  auto arguments = std::make_shared<RecordArguments>();
  add_domain(app, arguments->shared);
  add_recorder_options(app, arguments->shared);
  app.add_option("--for", arguments->for_s, "Stop after so many seconds")
      ->check(CLI::PositiveNumber);
  return [arguments] { return run_record(*arguments); };
}

std::function<int()> prepare_replay(CLI::App& app) {
  auto arguments = std::make_shared<ReplayArguments>();
  app.add_option("file", arguments->file, "MCAP file")->required()->check(CLI::ExistingFile);
  app.add_option("--speed", arguments->speed, "Recorded seconds in a second")
      ->check(CLI::Range(0.01, 100.0))
      ->capture_default_str();
  app.add_flag("--again", arguments->again, "From the beginning when it has ended");
  app.add_flag("--onto-dds", arguments->onto_dds, "Write to the bus, instead of serving the page");
  app.add_flag("--with-commands", arguments->with_commands,
               "With --onto-dds: also orders and setpoints, which move vehicles");
  add_domain(app, arguments->shared);
  add_server_options(app, arguments->shared);
  return [arguments] { return run_replay(*arguments); };
}

}  // namespace foretrack
