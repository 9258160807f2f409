#include "services/ground_station/station.hpp"

#include <spdlog/spdlog.h>

#include <cstdio>
#include <thread>

#include "services/ground_station/bus/bus.hpp"
#include "services/ground_station/http/files.hpp"
#include "services/ground_station/status.hpp"

namespace foretrack::station {
namespace {

constexpr double kStatusPeriod_s = 0.5;
constexpr double kCheckPeriod_s = 0.25;
constexpr char kVersion[] = FORETRACK_VERSION;

constexpr char kNoPage[] =
    "<!doctype html><meta charset=utf-8><title>foretrack station</title>"
    "<p>The station runs, but its page was not built: install npm and call <code>./run "
    "build</code>."
    "<p>Foxglove and Lichtblick connect to <code>ws://</code>this host<code>/ws</code>; "
    "<a href=/api/status>the status</a> is there too.";

class Station {
 public:
  explicit Station(const StationOptions& options)
      : options_(options),
        node_(options.node),
        hub_("foretrack station", kVersion, options.limits),
        server_(options.server, hub_),
        bus_(node_, outlet()),
        started_s_(steady_s()) {
    set_up_server();
  }

  void run(Stop& stop) {
    std::thread bus([&] {
      bus_.run(stop);
      server_.stop();
    });
    server_.run();
    bus.join();
  }

  unsigned short port() const { return server_.port(); }

 private:
  // The bus's thread tells; everything else happens in the server's.
  Outlet outlet() {
    return {[this](const Channel& c) { server_.post([this, c] { hub_.open(c); }); },
            [this](std::uint32_t id) { server_.post([this, id] { hub_.close(id); }); },
            [this](const std::vector<Sample>& samples) {
              server_.post([this, samples] { hub_.deliver(samples, steady_s()); });
            }};
  }
  void set_up_server();
  GuardOptions guard() const;
  void answer(const Request& request, const Respond& respond);
  Status status();
  void publish_status();

  StationOptions options_;
  Node node_;
  Hub hub_;
  Server server_;
  Bus bus_;
  double started_s_;
};

GuardOptions Station::guard() const {
  GuardOptions guard;
  const bool tls = !options_.server.certificate_file.empty();
  const auto port = ':' + std::to_string(server_.port());
  for (const auto* name : {"127.0.0.1", "localhost", "[::1]"}) guard.hosts.insert(name + port);
  guard.hosts.insert(options_.server.address + port);
  for (const auto& host : options_.more_hosts) guard.hosts.insert(host);
  for (const auto& host : guard.hosts) guard.origins.insert((tls ? "https://" : "http://") + host);
  for (const auto& origin : options_.more_origins) guard.origins.insert(origin);
  return guard;
}

void Station::set_up_server() {
  server_.set_guard(guard());
  server_.set_admission([](const Request&) { return std::string(); });
  server_.set_handler(
      [this](const Request& request, const Respond& respond) { answer(request, respond); });
  hub_.open(status_channel());
  hub_.on_interest = [this] { bus_.want(hub_.wanted()); };
  server_.every(kStatusPeriod_s, [this] { publish_status(); });
  server_.every(kCheckPeriod_s, [this] { hub_.check(steady_s()); });
}

void Station::answer(const Request& request, const Respond& respond) {
  if (request.method != "GET" && request.method != "HEAD")
    return respond(text_response(405, "this station only shows"));
  if (request.path == "/api/status") return respond(json_response(200, to_json_text(status())));
  auto response = serve_file(options_.page, request.path, request.range, false);
  if (response.status == 404 && request.path == "/") {
    response = text_response(200, kNoPage);
    response.type = "text/html; charset=utf-8";
  }
  respond(std::move(response));
}

Status Station::status() {
  const double now_s = steady_s();
  Status status;
  status.server = {kVersion, now_s - started_s_, false, false};
  status.vehicles = bus_.vehicles();
  status.topics = bus_.topics();
  for (const auto& topic : status.topics)
    if (hub_.limited(topic.channel, now_s)) status.limited.insert(topic.channel);
  status.clients = hub_.clients(now_s);
  return status;
}

void Station::publish_status() {
  const auto text = to_json_text(status());
  hub_.deliver({{0, now_ns(), std::make_shared<const Bytes>(text.begin(), text.end())}},
               steady_s());
}

}  // namespace

void run_station(const StationOptions& options, Stop& stop) {
  Station station(options);
  std::printf("station: http://%s:%u/\n", options.server.address.c_str(), station.port());
  std::fflush(stdout);
  station.run(stop);
}

}  // namespace foretrack::station
