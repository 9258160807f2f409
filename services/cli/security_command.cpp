// SPDX-License-Identifier: Apache-2.0
// foretrack security: keys and certificates for a secured bus.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <ctime>
#include <memory>

#include "services/cli/commands.hpp"
#include "services/security/inspect.hpp"
#include "services/security/keystore.hpp"

namespace foretrack {
namespace {

using namespace security;

constexpr std::time_t kDay_s = 86400;

struct SecurityArguments {
  std::string folder;
  Identity identity;
  std::vector<std::string> roles;
  int days = 0;
  bool of_simulation = false, fleet = false, replaced = false;
};

// From yesterday, as the vehicle's clock may be behind.
Validity for_days(int days) {
  const std::time_t now = std::time(nullptr);
  return {now - kDay_s, now + days * kDay_s};
}

std::string names_of_roles() {
  std::string text;
  for (const Role role : kRoles)
    text += fmt::format("{}{}", text.empty() ? "" : ", ", name_of(role));
  return text;
}

std::vector<Role> roles_of(const SecurityArguments& a, bool of_simulation) {
  std::vector<Role> result;
  for (const auto& name : a.roles) result.push_back(*role_of(name));
  if (!result.empty()) return result;
  for (const Role role : kRoles)
    if (role != Role::kSimulator || of_simulation) result.push_back(role);
  return result;
}

int run_init(const SecurityArguments& a) {
  const auto store = Keystore::create(a.folder, a.of_simulation, for_days(a.days));
  fmt::print(
      "{}: a keystore for {}. {}/private stays where it is: whoever has it can be anybody.\n",
      a.folder, store.of_simulation() ? "simulations" : "vehicles", a.folder);
  return 0;
}

int run_issue(SecurityArguments a) {
  Keystore store(a.folder);
  if (a.fleet == !a.identity.names.vehicle.empty())
    throw std::invalid_argument("the name of a vehicle is expected, or --fleet");
  if (a.fleet) a.identity.names.vehicle = kAllVehicles;
  for (const Role role : roles_of(a, store.of_simulation())) {
    a.identity.role = role;
    fmt::print("{}\n", store.issue(a.identity, for_days(a.days)).string());
  }
  return 0;
}

int run_revoke(const SecurityArguments& a) {
  Keystore store(a.folder);
  Identity identity = a.identity;
  identity.role = *role_of(a.roles.front());
  if (a.fleet) identity.names.vehicle = kAllVehicles;
  const int revoked = store.revoke(enclave_of(identity), a.replaced);
  fmt::print(
      "{} certificates of {} are revoked. Copy {}/public/crl.pem over the crl.pem of every "
      "identity in use, and start their processes again: they read it when they start.\n",
      revoked, enclave_of(identity), a.folder);
  return 0;
}

int run_check(const SecurityArguments& a) {
  const auto found = inspect(a.folder);
  if (found.empty()) throw std::invalid_argument(fmt::format("{} holds no identity", a.folder));
  for (const auto& one : found)
    fmt::print("{:4} {:<28} {:>5.0f} days  {}\n", one.fault.empty() ? "ok" : "BAD", one.name,
               one.days_left, one.fault.empty() ? one.advice : one.fault);
  return std::ranges::all_of(found, [](const auto& one) { return one.fault.empty(); }) ? 0 : 1;
}

void add_keystore(CLI::App& app, SecurityArguments& a) {
  app.add_option("keystore", a.folder, "its folder")->required();
}

void add_roles(CLI::App& app, SecurityArguments& a) {
  app.add_option("role", a.roles, names_of_roles())->check([](const std::string& name) {
    return role_of(name) ? "" : fmt::format("'{}' is none of {}", name, names_of_roles());
  });
  app.add_flag("--fleet", a.fleet, "for all vehicles");
  app.add_option("--name", a.identity.person, "of one of several, each to be revoked alone: ada");
}

void add_days(CLI::App& app, SecurityArguments& a, int days) {
  a.days = days;
  app.add_option("--days", a.days, "until it ends")
      ->check(CLI::Range(1, 36500))
      ->capture_default_str();
}

using Shared = std::shared_ptr<SecurityArguments>;

void prepare_init(CLI::App& app, const Shared& a) {
  add_keystore(app, *a);
  app.add_flag("--simulation", a->of_simulation, "for simulated vehicles and their simulator");
  add_days(app, *a, 3650);
}

void prepare_issue(CLI::App& app, const Shared& a) {
  add_keystore(app, *a);
  a->identity.names.vehicle.clear();
  app.add_option("--vehicle", a->identity.names.vehicle, "its name");
  add_roles(app, *a);
  add_days(app, *a, 365);
  app.add_option("--domain", a->identity.domain_id, "this DDS domain alone")
      ->check(CLI::Range(0, 232));
  app.add_option("--px4-namespace", a->identity.names.px4_namespace, "px4_<n> if PX4 has one");
  app.add_option("--clock-topic", a->identity.names.clock_topic, "of the simulator")
      ->capture_default_str();
}

void prepare_revoke(CLI::App& app, const Shared& a) {
  add_keystore(app, *a);
  app.add_option("--vehicle", a->identity.names.vehicle, "its name")->capture_default_str();
  add_roles(app, *a);
  app.get_option("role")->required()->expected(1);
  app.add_flag("--replaced", a->replaced, "only certificates that were renewed since");
}

void prepare_check(CLI::App& app, const Shared& a) {
  app.add_option("folder", a->folder, "a keystore, a vehicle's folder in it, or an identity")
      ->required();
}

}  // namespace

std::function<int()> prepare_security(CLI::App& app) {
  struct Sub {
    const char *name, *summary;
    void (*prepare)(CLI::App&, const Shared&);
    int (*run)(const SecurityArguments&);
  };
  static constexpr Sub kSubs[] = {
      {"init", "a new keystore: two authorities", prepare_init, run_init},
      {"issue", "identities of a vehicle, all roles or those named; again: renews them",
       prepare_issue, [](const SecurityArguments& a) { return run_issue(a); }},
      {"check", "what is wrong with identities, and when they end", prepare_check, run_check},
      {"revoke", "certificates that shall not be believed any more", prepare_revoke, run_revoke}};
  app.require_subcommand(1);
  const auto chosen = std::make_shared<std::function<int()>>();
  for (const auto& sub : kSubs) {
    const auto arguments = std::make_shared<SecurityArguments>();
    CLI::App* command = app.add_subcommand(sub.name, sub.summary);
    sub.prepare(*command, arguments);
    command->callback([chosen, run = sub.run, arguments] {
      *chosen = [run, arguments] { return run(*arguments); };
    });
  }
  return [chosen] { return (*chosen)(); };
}

}  // namespace foretrack
