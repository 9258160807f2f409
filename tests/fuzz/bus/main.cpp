// SPDX-License-Identifier: Apache-2.0
// fuzz_bus: messages that nobody should send, against a living participant. Bounded in the tests,
// for hours by hand (`./run fuzz MINUTES`). The process is to live on, to speak with newcomers, and
// to keep its memory.
#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "tests/fuzz/bus/attack.hpp"
#include "tests/fuzz/bus/peer.hpp"

namespace foretrack::testing {
namespace {

constexpr double kMostMemory_MB = 600.0;

int run(const AttackOptions& options) {
  const AttackResult result = attack(options);
  fmt::print(
      "seed {}: {} messages sent, {} of them let through, from {} good ones; victim {}, {:.0f} "
      "MB\n",
      options.seed, result.sent, result.let_through, result.seeds,
      result.ended   ? "ended " + result.how
      : result.hears ? "lives and hears newcomers"
                     : "lives and hears nobody",
      result.memory_MB);
  std::fflush(stdout);
  return result.ended || !result.hears || result.memory_MB > kMostMemory_MB ? 1 : 0;
}

// The packet of 82 bytes that ended every process. It must end one without the filter, or the test
// says nothing.
int run_known(AttackOptions options) {
  Message message = {'R', 'T', 'P', 'S', 2, 3, 1, 0x0f};
  message.resize(20);
  message.insert(message.end(), {0x80, 1, 0x38, 0});
  message.resize(82);
  options.filtered = true;
  const auto with = send_one(message, options);
  options.filtered = false;
  const auto without = send_one(message, options);
  fmt::print("82 bytes: with the filter {}, without it {}\n", with.empty() ? "lives" : with,
             without.empty() ? "lives" : without);
  return with.empty() && !without.empty() ? 0 : 1;
}

}  // namespace
}  // namespace foretrack::testing

int main(int argc, char** argv) {
  using namespace foretrack::testing;
  CLI::App app("Bad messages against a living participant");
  AttackOptions options;
  bool victim = false, open_victim = false, known = false, open = false;
  int domain = 0, rounds = 1;
  std::string security;
  app.add_option("--seconds", options.seconds, "Of one round")->capture_default_str();
  app.add_option("--rounds", rounds, "One seed after the other, a new victim each");
  app.add_option("--seed", options.seed, "Of the first round")->capture_default_str();
  app.add_option("--record", options.record, "File for the last messages, if the victim ends");
  app.add_option("--program", options.program, "Attack this instead, with its arguments");
  app.add_option("--hold", options.hold_s, "Keep a victim that hears nobody for so many seconds");
  app.add_flag("--known", known, "Send the one message that is known to kill");
  app.add_flag("--open", open, "Attack a participant without the filter");
  app.add_flag("--victim", victim, "Be attacked")->group("");
  app.add_flag("--open-victim", open_victim, "Be attacked without the filter")->group("");
  app.add_option("--keys", options.keys, "Folder of enclaves (tests/support/keystore.py): secured");
  app.add_option("--security", security, "Of the victim")->group("");
  app.add_option("--domain", domain, "Of the victim")->group("");
  CLI11_PARSE(app, argc, argv);
  if (victim || open_victim) Peer::be_the_victim(domain, victim, security);
  options.filtered = !open;
  if (known) return run_known(options);
  for (int round = 0; round < rounds; ++round, ++options.seed)
    if (const int fault = run(options)) return fault;
  return 0;
}
