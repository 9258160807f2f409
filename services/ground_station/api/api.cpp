// SPDX-License-Identifier: Apache-2.0
#include "services/ground_station/api/api.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "services/ground_station/api/order_body.hpp"
#include "services/ground_station/http/files.hpp"
#include "services/ground_station/http/guard.hpp"

namespace foretrack::station {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr double kRequests_s = 20.0;
constexpr std::size_t kMaxName = 32;
constexpr std::string_view kRecordings = "/recordings/";
constexpr std::string_view kReports = "/reports/";
constexpr std::string_view kClips = "/clips/";
constexpr std::string_view kFolders[] = {kRecordings, kReports, kClips};

Response outcome_response(int status, const Outcome& outcome) {
  const Json said{{"ok", outcome.ok}, {"reason", outcome.reason}, {"answered", outcome.answered}};
  return json_response(status, said.dump());
}

std::string text_of(const Json& json, const char* key) {
  const auto it = json.find(key);
  return it != json.end() && it->is_string() ? it->get<std::string>() : "";
}

// It goes into topics' names, logs and other operators' screens.
bool is_name(const std::string& text) {
  return !text.empty() && text.size() <= kMaxName &&
         std::all_of(text.begin(), text.end(), [](unsigned char c) {
           return std::isalnum(c) || c == '_' || c == '-' || c == '.' || c == ' ';
         });
}

std::string list_recordings(const fs::path& folder) {
  Json list = Json::array();
  std::error_code error;
  std::vector<fs::directory_entry> entries;
  for (const auto& entry : fs::directory_iterator(folder, error))
    if (entry.path().extension() == ".mcap") entries.push_back(entry);
  std::sort(entries.begin(), entries.end());
  for (const auto& entry : entries)
    list.push_back({{"file", entry.path().filename().string()}, {"bytes", entry.file_size(error)}});
  return list.dump();
}

// /reports/<file>.html → <file>.mcap; empty: the path names none.
std::string recording_of(std::string_view path, std::string_view folder, std::string_view end) {
  if (!path.starts_with(folder) || !path.ends_with(end)) return {};
  if (path.size() < folder.size() + end.size()) return {};
  const auto name = path.substr(folder.size(), path.size() - folder.size() - end.size());
  const bool leads_out = name.empty() || name.find('/') != name.npos || name.starts_with('.');
  return leads_out ? "" : std::string(name) + ".mcap";
}

}  // namespace

/// A POST that was allowed so far.
struct Api::Order {
  Json body;
  std::string vehicle, name, action;
  std::string remote;
  Report report;  // notes it in the audit log and answers
};

Api::Api(const ApiOptions& options, const Tokens& tokens, Audit& audit, Commander* commander,
         Recorder& recorder, std::function<std::string()> status, FileMaker::Post post)
    : options_(options),
      tokens_(tokens),
      audit_(audit),
      commander_(commander),
      recorder_(recorder),
      status_(std::move(status)),
      files_(std::move(post)),
      allowance_(kRequests_s) {}

std::string Api::refusal_to_read(const Request& request) const {
  if (!options_.token_to_read || tokens_.owner(token_of(request))) return {};
  return "a valid token expected";
}

bool Api::handle(const Request& request, const Respond& respond, double now_s) {
  const bool is_api = request.path.starts_with("/api/");
  const bool is_file = std::any_of(std::begin(kFolders), std::end(kFolders),
                                   [&](auto folder) { return request.path.starts_with(folder); });
  if (!is_api && !is_file) return false;
  if (const auto why = refusal_to_read(request); !why.empty()) {
    audit_.note({{"event", "refused"}, {"remote", request.remote}, {"path", request.path}});
    respond(outcome_response(401, {false, why}));
  } else if (request.method == "GET" || request.method == "HEAD") {
    get(request, respond);
  } else if (request.method == "POST" && is_api) {
    post(request, respond, now_s);
  } else {
    respond(outcome_response(405, {false, "GET or POST expected"}));
  }
  return true;
}

void Api::get(const Request& request, const Respond& respond) {
  if (request.path == "/api/status") return respond(json_response(200, status_()));
  if (request.path == "/api/recordings")
    return respond(json_response(200, list_recordings(options_.recordings)));
  if (request.path.starts_with(kRecordings) && request.path.ends_with(".mcap"))
    return respond(serve_file(options_.recordings, request.path.substr(kRecordings.size() - 1),
                              request.range, false));
  if (const auto file = recording_of(request.path, kReports, ".html"); !file.empty())
    return files_.make(options_.recordings / file, report_of, respond);
  if (const auto file = recording_of(request.path, kClips, ".webm"); !file.empty()) {
    const auto clip = [query = request.query](const fs::path& recording) {
      return clip_of(recording, query);
    };
    return files_.make(options_.recordings / file, clip, respond);
  }
  respond(outcome_response(404, {false, "there is no such thing"}));
}

bool Api::may_ask(double now_s) {
  allowance_ = std::min(kRequests_s, allowance_ + kRequests_s * (now_s - asked_s_));
  asked_s_ = now_s;
  if (allowance_ < 1.0) return false;
  allowance_ -= 1.0;
  return true;
}

void Api::post(const Request& request, const Respond& respond, double now_s) {
  const auto refuse = [&](int status, const std::string& why) {
    audit_.note({{"event", "refused"},
                 {"remote", request.remote},
                 {"path", request.path},
                 {"reason", why}});
    respond(outcome_response(status, {false, why}));
  };
  // A flood of wrong tokens must not keep the operator from stopping a vehicle.
  const auto token = token_of(request);
  const bool known = tokens_.owner(token).has_value();
  if (!known && !may_ask(now_s))
    return respond(outcome_response(429, {false, "too many requests"}));
  if (!known) return refuse(401, "a valid token expected");
  Order order;
  order.body = Json::parse(request.body, nullptr, false);
  if (!order.body.is_object()) return refuse(400, "a JSON object expected");
  order.vehicle = text_of(order.body, "vehicle");
  order.name = text_of(order.body, "operator");
  order.action = text_of(order.body, request.path == "/api/command" ? "command" : "action");
  order.remote = request.remote;
  order.report = [this, respond, path = request.path, o = order](const Outcome& outcome) {
    audit_.note({{"event", path.substr(5)},
                 {"remote", o.remote},
                 {"vehicle", o.vehicle},
                 {"operator", o.name},
                 {"action", o.action},
                 {"result", outcome.ok ? "ok" : "refused"},
                 {"reason", outcome.reason}});
    respond(outcome_response(outcome.ok ? 200 : 409, outcome));
  };
  if (request.path == "/api/record") return record(order);
  if (request.path != "/api/lease" && request.path != "/api/command")
    return refuse(404, "there is no such thing");
  if (!options_.enable_control || !commander_)
    return refuse(403, "control is not enabled on this station");
  if (!is_name(order.name) || !is_name(order.vehicle))
    return refuse(400, "'vehicle' and 'operator' expected: letters, digits and _-. at most 32");
  if (!tokens_.may_act_as(token, order.name))
    return refuse(403, "this token is not the operator's");
  request.path == "/api/lease" ? lease(order, now_s) : command(order, now_s);
}

void Api::lease(const Order& order, double now_s) {
  const auto& [body, vehicle, name, action, remote, report] = order;
  if (action == "take") return commander_->take(vehicle, name, now_s, report);
  if (action == "release") return commander_->release(vehicle, name, now_s, report);
  const auto to = text_of(body, "to");
  if (action == "hand_over" && is_name(to))
    return commander_->hand_over(vehicle, name, to, now_s, report);
  report({false, "'action' take, release, or hand_over with 'to' expected"});
}

void Api::command(const Order& order, double now_s) {
  auto command = read_order(order.body);
  if (!command) return order.report({false, command.fault().text});
  command->operator_name = order.name;
  commander_->command(order.vehicle, *command, now_s, order.report);
}

void Api::record(const Order& order) {
  if (order.action == "start") {
    const auto fault = recorder_.start();
    order.report({fault.empty(), fault});
  } else if (order.action == "stop") {
    recorder_.end();
    order.report({true, ""});
  } else {
    return order.report({false, "'action' start or stop expected"});
  }
  if (on_recording) on_recording();
}

}  // namespace foretrack::station
