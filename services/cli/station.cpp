// foretrack station: the ground station's server.
#include "services/ground_station/station.hpp"

#include <memory>

#include "services/cli/bus_options.hpp"
#include "services/cli/commands.hpp"
#include "services/common/options.hpp"
#include "services/share/share.hpp"

namespace foretrack {
namespace {

struct StationArguments {
  station::StationOptions options;
  std::string page;
};

std::filesystem::path page_folder(const std::string& chosen) {
  if (!chosen.empty()) return chosen;
  for (const auto& folder : share_folders())
    for (const char* place : {"page", "services/ground_station/web/dist"})
      if (std::filesystem::exists(folder / place / "index.html")) return folder / place;
  return {};
}

int run(StationArguments arguments) {
  set_up_logging("warning");
  Stop stop;
  SignalStop signals(stop);
  auto& options = arguments.options;
  options.node.service = "station";
  options.page = page_folder(arguments.page);
  run_station(options, stop);
  return 0;
}

}  // namespace

std::function<int()> prepare_station(CLI::App& app) {
  auto arguments = std::make_shared<StationArguments>();
  auto& options = arguments->options;
  app.add_option("--domain", options.node.domain_id, "DDS domain")
      ->envname("ROS_DOMAIN_ID")
      ->check(CLI::Range(0, 232))
      ->capture_default_str();
  app.add_option("--address", options.server.address, "To listen on")->capture_default_str();
  app.add_option("--port", options.server.port, "To listen on; 0: a free one")
      ->capture_default_str();
  app.add_option("--page", arguments->page, "Folder of the page")->check(CLI::ExistingDirectory);
  app.add_option("--allow-host", options.more_hosts, "Also answer to this name:port");
  app.add_option("--allow-origin", options.more_origins,
                 "Also serve pages from this origin: https://app.foxglove.dev");
  return [arguments] { return run(*arguments); };
}

}  // namespace foretrack
