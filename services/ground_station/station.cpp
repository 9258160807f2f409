// SPDX-License-Identifier: Apache-2.0
#include "services/ground_station/station.hpp"

#include <malloc.h>
#include <sys/resource.h>

#include <cstdio>
#include <cstdlib>
#include <stdexcept>
#include <thread>

#include "core/version.hpp"
#include "services/ground_station/api/api.hpp"
#include "services/ground_station/bus/bus.hpp"
#include "services/ground_station/bus/contract.hpp"
#include "services/ground_station/ground_map/ground_map.hpp"
#include "services/ground_station/http/files.hpp"
#include "services/ground_station/hub/video_chain.hpp"
#include "services/ground_station/recording/recover.hpp"
#include "services/ground_station/status.hpp"

namespace foretrack::station {
namespace {

constexpr double kStatusPeriod_s = 0.5;
constexpr double kCheckPeriod_s = 0.25;
constexpr double kCommandPeriod_s = 0.02;
constexpr int kNiceness = 5;  // what flies comes first, where both share a machine
constexpr std::string_view kSafetyTopic = "/safety/state";
constexpr std::string_view kImageSchema = "sensor_msgs/msg/CompressedImage";

constexpr char kNoPage[] =
    "<!doctype html><meta charset=utf-8><title>foretrack station</title>"
    "<p>The station runs, but its page was not built: install npm, then <code>./run build</code>."
    "<p>Foxglove and Lichtblick connect to <code>ws://</code>this host<code>/ws</code>; "
    "<a href=/api/status>the status</a> is there too.";

bool is_loopback(const std::string& address) {
  return address.starts_with("127.") || address == "::1";
}

class Station {
 public:
  Station(const StationOptions& options, Stop& stop);
  void run();
  std::string url() const;
  /// Whom it hears, in a sentence; empty: a recording.
  std::string hears() const { return hears_; }

 private:
  Outlet outlet();
  void set_up_server();
  GuardOptions guard() const;
  void deliver(const std::vector<Sample>& samples);
  void answer(const Request& request, const Respond& respond);
  void answer_map(const Request& request, const Respond& respond);
  void publish_status();
  void expect_page();
  std::set<std::uint32_t> interest() const;
  void update_interest();
  bool uses_tls() const { return !options_.server.certificate_file.empty(); }
  Status status();

  StationOptions options_;
  Stop& stop_;
  Tokens tokens_;
  Audit audit_;
  Hub hub_;
  Server server_;
  Recorder recorder_;
  Bus* bus_ = nullptr;  // none: a recording is replayed
  std::string hears_;
  std::unique_ptr<Source> source_;
  std::unique_ptr<Commander> commander_;
  std::unique_ptr<Api> api_;
  std::optional<GroundMap> ground_map_;
  std::map<std::uint32_t, std::string> safety_channels_;  // → vehicle
  double started_s_ = steady_s();
};

Station::Station(const StationOptions& options, Stop& stop)
    : options_(options),
      stop_(stop),
      tokens_(Tokens::load_or_create(options.token_file)),
      audit_(options.audit_file),
      hub_("foretrack station", kVersion, options.limits),
      server_(options.server, hub_),
      recorder_(options.recorder) {
  if (!options_.map.empty()) ground_map_ = GroundMap::load(options_.map);
  if (options_.replay) {
    source_ = std::make_unique<Replay>(*options_.replay, outlet());
  } else {
    const auto node = std::make_shared<Node>(options_.node);
    hears_ = node->this_machine_only() ? "only this machine is heard; --interface NAME hears others"
                                       : node->why_unsecured();
    auto bus = std::make_unique<Bus>(node, outlet());
    bus_ = bus.get();
    source_ = std::move(bus);
    commander_ =
        std::make_unique<Commander>(node, options_.enable_control,
                                    [this](const std::string& topic) { bus_->expect_own(topic); });
    commander_->on_unanswered = [this](const std::string& why) { bus_->ask_to_rejoin(why); };
    bus_->on_rejoin = [this](std::shared_ptr<Node> fresh) {
      server_.post([this, fresh = std::move(fresh)] { commander_->move_to(fresh); });
    };
  }
  const ApiOptions api{options_.enable_control, !is_loopback(options_.server.address),
                       options_.recorder.folder};
  api_ = std::make_unique<Api>(
      api, tokens_, audit_, commander_.get(), recorder_, [this] { return to_json_text(status()); },
      [this](auto work) { server_.post(std::move(work)); });
  api_->on_recording = [this] { update_interest(), publish_status(); };
  set_up_server();
}

// The source's thread tells; all but the recorder's part happens in the server's.
Outlet Station::outlet() {
  return {[this](const Channel& c) {
            recorder_.open(c);
            server_.post([this, c] {
              hub_.open(c);
              if (const auto vehicle = vehicle_of(c.wire);
                  !vehicle.empty() && c.wire.ends_with(kSafetyTopic))
                safety_channels_[c.id] = vehicle;
              update_interest();
            });
          },
          [this](std::uint32_t id) { server_.post([this, id] { hub_.close(id); }); },
          [this](const std::vector<Sample>& samples) {
            recorder_.samples(samples);
            server_.post([this, samples] { deliver(samples); });
          }};
}

void Station::deliver(const std::vector<Sample>& samples) {
  const double now_s = steady_s();
  if (commander_)
    for (const auto& sample : samples)
      if (const auto it = safety_channels_.find(sample.channel); it != safety_channels_.end())
        commander_->hear(it->second, *sample.data, now_s);
  hub_.deliver(samples, now_s);
}

GuardOptions Station::guard() const {
  GuardOptions guard;
  const auto port = ':' + std::to_string(server_.port());
  for (const auto* name : {"127.0.0.1", "localhost", "[::1]"}) guard.hosts.insert(name + port);
  guard.hosts.insert(options_.server.address + port);
  for (const auto& host : options_.more_hosts) guard.hosts.insert(host);
  for (const auto& host : guard.hosts)
    guard.origins.insert((uses_tls() ? "https://" : "http://") + host);
  for (const auto& origin : options_.more_origins) guard.origins.insert(origin);
  return guard;
}

void Station::set_up_server() {
  server_.set_guard(guard());
  server_.set_admission([this](const Request& request) {
    const auto why = api_->refusal_to_read(request);
    if (!why.empty()) audit_.note({{"event", "refused"}, {"remote", request.remote}});
    return why;
  });
  server_.set_handler(
      [this](const Request& request, const Respond& respond) { answer(request, respond); });
  hub_.open(status_channel());
  recorder_.open(status_channel());
  hub_.on_interest = [this] { update_interest(); };
  server_.every(kStatusPeriod_s, [this] { publish_status(); });
  server_.every(kCheckPeriod_s, [this] { hub_.check(steady_s()); });
  if (commander_) server_.every(kCommandPeriod_s, [this] { commander_->tick(steady_s()); });
}

std::set<std::uint32_t> Station::interest() const {
  auto wanted = hub_.wanted();
  wanted.merge(recorder_.wanted());
  return wanted;
}

void Station::update_interest() {
  source_->want(interest());
}

void Station::answer(const Request& request, const Respond& respond) {
  if (api_->handle(request, respond, steady_s())) return;
  if (request.method != "GET" && request.method != "HEAD")
    return respond(text_response(405, "GET expected"));
  if (request.path == "/map.json" || request.path.starts_with("/map/"))
    return answer_map(request, respond);
  if (request.path == "/") expect_page();
  auto response = serve_file(options_.page, request.path, request.range, false);
  if (response.status == 404 && request.path == "/") {
    response = text_response(200, kNoPage);
    response.type = "text/html; charset=utf-8";
  }
  respond(std::move(response));
}

// Whoever opens the page waits for a picture of its first vehicle: it is read from now on, while
// the page still loads. If nobody subscribes, it rests again.
void Station::expect_page() {
  std::map<std::string, std::uint32_t> images;
  for (const auto& [id, channel] : hub_.channels())
    if (is_ground_picture(channel) && channel.schema_name == kImageSchema)
      images[channel.topic] = id;
  if (images.empty()) return;
  auto wanted = interest();
  wanted.insert(images.begin()->second);
  source_->want(std::move(wanted));
}

// Where the page needs a token, so does what shows where one flies.
void Station::answer_map(const Request& request, const Respond& respond) {
  if (const auto why = api_->refusal_to_read(request); !why.empty())
    return respond(text_response(401, why));
  if (ground_map_) return respond(ground_map_->answer(request));
  const bool asks_whether = request.path == "/map.json";
  respond(asks_whether ? json_response(200, "null") : text_response(404, "there is no map"));
}

Status Station::status() {
  const double now_s = steady_s();
  Status status;
  status.server = {kVersion, now_s - started_s_, options_.enable_control && commander_, true};
  status.vehicles = source_->vehicles();
  status.topics = source_->topics();
  status.warnings = source_->warnings();
  if (commander_) status.missions = commander_->missions(now_s);
  status.recording = recorder_.status();
  status.recording_fault = recorder_.fault();
  for (const auto& topic : status.topics)
    if (hub_.limited(topic.channel, now_s)) status.limited.insert(topic.channel);
  status.clients = hub_.clients(now_s);
  return status;
}

foxglove::Graph graph_of(const std::vector<TopicReport>& topics) {
  foxglove::Graph graph;
  for (const auto& t : topics) graph[t.topic] = {t.publishers, t.subscribers};
  return graph;
}

void Station::publish_status() {
  const auto now = status();
  hub_.set_graph(graph_of(now.topics));
  const auto text = to_json_text(now);
  const std::vector<Sample> samples{
      {0, now_ns(), std::make_shared<const Bytes>(text.begin(), text.end())}};
  recorder_.samples(samples);
  hub_.deliver(samples, steady_s());
}

std::string Station::url() const {
  std::string url = uses_tls() ? "https://" : "http://";
  url += options_.server.address + ':' + std::to_string(server_.port()) + '/';
  if (options_.print_token) url += "#token=" + tokens_.first();
  return url;
}

void Station::run() {
  recover_recordings(options_.recorder.folder);
  if (options_.record)
    if (const auto fault = recorder_.start(); !fault.empty()) throw std::runtime_error(fault);
  std::thread source([this] {
    source_->run(stop_);
    server_.stop();
  });
  server_.run();
  source.join();
  recorder_.stop();
}

std::filesystem::path home_folder(const char* variable, const char* fallback) {
  if (const char* folder = std::getenv(variable); folder && *folder) return folder;
  const char* home = std::getenv("HOME");
  return std::filesystem::path(home ? home : "/tmp") / fallback;
}

void validate_or_throw(const StationOptions& options) {
  if (!options.server.certificate_file.empty() != !options.server.key_file.empty())
    throw std::invalid_argument("TLS needs both --certificate and --key");
  if (is_loopback(options.server.address) || options.insecure_lan ||
      !options.server.certificate_file.empty())
    return;
  throw std::invalid_argument(
      "address " + options.server.address +
      " can be reached by others: give --certificate and --key, or --insecure-lan to send the "
      "token and everything else in the clear");
}

}  // namespace

std::filesystem::path default_token_file() {
  return home_folder("XDG_CONFIG_HOME", ".config") / "foretrack" / "station.tokens";
}

std::filesystem::path default_audit_file() {
  return home_folder("XDG_STATE_HOME", ".local/state") / "foretrack" / "station-audit.jsonl";
}

void run_station(const StationOptions& options, Stop& stop) {
  validate_or_throw(options);
  setpriority(PRIO_PROCESS, 0, kNiceness);
  mallopt(M_ARENA_MAX, 2);  // images go from thread to thread: more would keep more of them
  Station station(options, stop);
  std::printf("station: %s\n", station.url().c_str());
  if (const auto hears = station.hears(); !hears.empty()) std::printf("%s\n", hears.c_str());
  if (!options.print_token) std::printf("operators' tokens: %s\n", options.token_file.c_str());
  std::fflush(stdout);
  station.run();
}

}  // namespace foretrack::station
