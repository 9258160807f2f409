// SPDX-License-Identifier: Apache-2.0
// foretrack check: whether a vehicle would start with its file, before it is in the field.
#include <fmt/format.h>

#include <filesystem>
#include <memory>

#include "services/cli/commands.hpp"
#include "services/cli/vehicle_file.hpp"
#include "services/common/identity.hpp"
#include "services/common/interfaces.hpp"
#include "services/common/options.hpp"
#include "services/common/rendezvous.hpp"
#include "services/files/config/load_params.hpp"

namespace foretrack {
namespace {

namespace fs = std::filesystem;

/// What was found, said at once.
class Findings {
 public:
  template <class Look>
  void look(const char* what, Look look) {
    try {
      say("ok", what, look());
    } catch (const std::exception& error) {
      say("BAD", what, error.what());
      ++faults_;
    }
  }
  void note(const char* what, const std::string& text) { say("note", what, text); }
  int exit_code() const { return faults_ > 0 ? 1 : 0; }

 private:
  static void say(const char* level, const char* what, const std::string& text) {
    fmt::print("{:4}  {:<10}  {}\n", level, what, text);
  }
  int faults_ = 0;
};

std::string names_of(const ServiceOptions& o, const fs::path& file) {
  validate_or_throw(o.names);
  if (o.names.vehicle != file.stem())
    throw std::invalid_argument(
        fmt::format("is '{}', and the file's name says {}: its units go by the file's name",
                    o.names.vehicle, file.stem().string()));
  return fmt::format("{}, DDS domain {}", o.names.vehicle, o.domain_id);
}

std::string params_of(const ServiceOptions& o) {
  if (o.params_file.empty()) return "all defaults";
  load_params(o.params_file);
  return o.params_file;
}

std::string network_of(const ServiceOptions& o) {
  std::string text = o.interface.empty() ? "this machine alone" : "interface " + o.interface;
  if (!o.interface.empty()) find_interfaces(o.interface);
  for (const auto& peer : o.peers)
    text += fmt::format(", peer {} by {}", peer, address_towards(find_meeting_point(peer)));
  if (!o.discovery_server.empty()) text += ", discovery server " + o.discovery_server;
  return text;
}

// Both processes of a vehicle have one.
std::string identities_of(const ServiceOptions& o) {
  for (const char* service : {"safety_gate", "planning"})
    if (const auto fault = fault_of_identity(identity_folder(o.security, service)); !fault.empty())
      throw std::invalid_argument(fault);
  if (!o.discovery_server.empty())
    throw std::invalid_argument("a discovery server cannot serve secured vehicles: name peers");
  return o.security;
}

void check_security(const ServiceOptions& o, Findings& findings) {
  if (o.security.empty()) {
    if (!o.interface.empty() || !o.peers.empty() || !o.discovery_server.empty())
      findings.note("security", "none: whoever is on that network can order (SECURITY.md)");
    return;
  }
  findings.look("security", [&] { return identities_of(o); });
  for (const char* service : {"safety_gate", "planning"}) try {
      const auto soon = soon_over(identity_folder(o.security, service));
      if (!soon.empty()) findings.note("security", soon);
    } catch (const std::exception&) {
      // said above
    }
}

int run_check(CLI::App& options_of_a_vehicle, const ServiceOptions& o, const std::string& file) {
  take_vehicle_file(options_of_a_vehicle, file);
  Findings findings;
  findings.look("vehicle", [&] { return names_of(o, file); });
  findings.look("network", [&] { return network_of(o); });
  check_security(o, findings);
  findings.look("params", [&] { return params_of(o); });
  return findings.exit_code();
}

}  // namespace

std::function<int()> prepare_check(CLI::App& app) {
  struct Check {
    CLI::App options_of_a_vehicle;
    ServiceOptions options;
    std::string file;
  };
  const auto check = std::make_shared<Check>();
  add_options(check->options_of_a_vehicle, check->options);
  app.add_option("file", check->file, "As /etc/foretrack/uav1.yaml")
      ->required()
      ->check(CLI::ExistingFile);
  return [check] { return run_check(check->options_of_a_vehicle, check->options, check->file); };
}

}  // namespace foretrack
