// SPDX-License-Identifier: Apache-2.0
// foretrack bench: the experiments, by many flights on all cores.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <functional>
#include <iterator>
#include <memory>

#include "services/cli/commands.hpp"
#include "services/offline/experiments/bench.hpp"
#include "services/offline/experiments/identity.hpp"

namespace foretrack {
namespace {

struct Options {
  std::vector<std::string> names = {"all"};
  std::vector<std::string> methods;  // empty: all; ours alone where nothing is compared
  std::vector<std::string> maps = {std::begin(kMapSourceNames), std::end(kMapSourceNames)};
  std::string out, logs = "failed";
  BenchRequest request;
  BenchOptions bench;
  bool report = true;
};

// What was flown until Ctrl-C is written; a second one ends the program at once.
volatile std::sig_atomic_t interrupted = 0;
void on_interrupt(int signal) {
  interrupted = 1;
  constexpr std::string_view kNote = "\nending with the flights under way; once more: at once\n";
  [[maybe_unused]] const auto written = write(STDERR_FILENO, kNote.data(), kNote.size());
  std::signal(signal, SIG_DFL);
}

std::string clock_of(double seconds) {
  const int s = static_cast<int>(std::lround(seconds));
  return s < 100 ? fmt::format("{} s", s) : fmt::format("{} min {:02} s", s / 60, s % 60);
}

std::function<void(const BenchProgress&)> progress_line() {
  const bool live = isatty(STDERR_FILENO);
  return [live, shown_s = 0.0](const BenchProgress& p) mutable {
    const double every_s = live ? 0.5 : 30.0;
    if (p.done < p.total && p.elapsed_s < shown_s + every_s) return;
    shown_s = p.elapsed_s;
    fmt::print(stderr, "{}{} of {} flights, {} so far, about {} left   {}", live ? "\r" : "",
               p.done, p.total, clock_of(p.elapsed_s), clock_of(p.left_s),
               live && p.done < p.total ? "" : "\n");
    std::fflush(stderr);
  };
}

void print_cells(const BenchResults& r) {
  fmt::print("{:<28}{:<13}{:<7}{:>5}  {:>9}  {:>13}  {:>6}  {:>6}  {:>5}  {:>5}  {:>4}\n",
             "experiment", "method", "map", "m/s", "success", "95 % interval", "fail %", "occl %",
             "near%", "dmin", "hits");
  for (const CellSummary& c : r.cells)
    fmt::print(
        "{:<28}{:<13}{:<7}{:>5.2f}  {:>4}/{:<4}  {:>5.1f} … {:>5.1f}  {:>6.2f}  {:>6.2f}  {:>5.2f}"
        "  {:>5.2f}  {:>4}\n",
        c.key.experiment, c.key.method, to_string(c.key.map), c.target_speed_m_s, c.successes,
        c.events, 100.0 * c.success_95.low, 100.0 * c.success_95.high, 100.0 * c.failure_rate,
        100.0 * c.occlusion_rate, 100.0 * c.near_rate, c.min_distance_m, c.collisions);
}

void print_comparisons(const BenchResults& r) {
  if (r.comparisons.empty()) return;
  fmt::print("\nPaired with {}, same seeds (McNemar, exact; failure rate: 95 % of a bootstrap)\n",
             kOurs);
  for (const Comparison& c : r.comparisons)
    fmt::print(
        "{:<28}{:<13}{:<7} only ours succeeded {:>4}, only theirs {:>4}, p = {:<9.2g} {:<16}"
        " failure rate {:+.2f} … {:+.2f} points\n",
        c.key.experiment, c.key.method, to_string(c.key.map), c.only_ours, c.only_theirs, c.p,
        c.significant() ? "significant" : "not significant", 100.0 * c.failure_difference.low,
        100.0 * c.failure_difference.high);
}

void print_failures(const BenchResults& r) {
  int shown = 0;
  for (std::size_t i = 0; i < r.jobs.size() && shown < 5; ++i) {
    if (!r.records[i].failed() || r.jobs[i].cell.method != kOurs) continue;
    if (shown++ == 0) fmt::print("\nFlights of {} with a failed event, to fly again:\n", kOurs);
    fmt::print("  {}\n", r.jobs[i].command);
  }
}

void print_encounters(const std::vector<EncounterCell>& cells, std::string_view what) {
  fmt::print(
      "\n{:<14}{:<13}{:<7}{:>4} {:>7} {:>6}  {:>8} {:>13}  {:>6} {:>6} {:>6}  {:>9}  {:>19}"
      "  {:>9} {:>6} {:>6}\n",
      what, "method", "map", "m/s", "flights", "met", "contacts", "95 % interval", "least", "p05",
      "p50", "floor", "stay/back/aside/up", "in view", "walls", "hovers");
  for (const EncounterCell& c : cells)
    fmt::print(
        "{:<14}{:<13}{:<7}{:>4.1f} {:>7} {:>6}  {:>3} ({:>2}u) {:>5.1f} … {:>5.1f}  {:>6.2f} "
        "{:>6.2f} {:>6.2f}  {:>4}/{:<4}  {:>19}  {:>4}/{:<4} {:>6} {:>6}\n",
        c.name, c.method, to_string(c.map), c.speed_m_s, c.flights, c.encounters, c.contacts(),
        c.unseen_contacts, 100.0 * c.contact_95.low, 100.0 * c.contact_95.high, c.gap_min_m,
        c.gap_p05_m, c.gap_p50_m, c.floor_kept, c.floor_judged,
        fmt::format("{}", fmt::join(c.evasions, "/")), c.view_kept, c.encounters, c.wall_contacts,
        c.hovering_flights);
}

void print_hidings(const std::vector<HidingCell>& cells) {
  if (cells.empty()) return;
  fmt::print("\n{:<10}{:<13}{:<7}{:>8}  {:>9}  {:>15}  {:>7} {:>7}  {:>8} {:>6}  {:>6}\n", "kind",
             "method", "map", "hidden s", "found 8 s", "95 % interval", "p50 s", "p90 s",
             "contacts", "walls", "gap m");
  for (const HidingCell& c : cells)
    fmt::print(
        "{:<10}{:<13}{:<7}{:>8}  {:>4}/{:<4}  {:>5.1f} … {:>5.1f} %  {:>7.1f} {:>7.1f}  {:>8} "
        "{:>6}  {:>6.2f}\n",
        c.name, c.method, to_string(c.map), fmt::format("{}–{}", c.hidden_from_s, c.hidden_to_s),
        c.found, c.hidings, 100.0 * c.found_95.low, 100.0 * c.found_95.high, c.until_found_p50_s,
        c.until_found_p90_s, c.contacts, c.wall_contacts, c.least_gap_m);
}

void print_fleets(const std::vector<FleetCell>& cells) {
  if (cells.empty()) return;
  fmt::print(
      "\n{:<10}{:<13}{:<7}{:>4} {:>7}  {:>7} {:>7} {:>7}  {:>11} {:>15} {:>8}  {:>6} {:>7} {:>5} "
      "{:>5} {:>6}\n",
      "fleet", "method", "map", "m/s", "flights", "union %", "two %", "band %", "seen 0.5 s",
      "95 % interval", "unseen s", "apart", "below s", "hits", "walls", "people");
  for (const FleetCell& c : cells)
    fmt::print(
        "{:<10}{:<13}{:<7}{:>4.1f} {:>7}  {:>7.2f} {:>7.2f} {:>7.2f}  {:>5}/{:<5} {:>6.1f} … "
        "{:>5.1f} {:>8.2f}  {:>6.2f} {:>7.2f} {:>5} {:>5} {:>6}\n",
        c.name, c.method, to_string(c.map), c.speed_m_s, c.flights, 100.0 * c.union_visibility,
        100.0 * c.k2_visibility, 100.0 * c.band_share, c.events_seen, c.events,
        100.0 * c.events_95.low, 100.0 * c.events_95.high, c.longest_unseen_s, c.min_separation_m,
        c.below_separation_s, c.contacts, c.wall_contacts, c.person_contacts);
}

std::string command_of(const Options& o) {
  const BenchRequest& q = o.request;
  std::string text =
      fmt::format("foretrack bench {} --methods {} --maps {}", fmt::join(o.names, " "),
                  fmt::join(q.methods, ","), fmt::join(o.maps, ","));
  if (q.seed > 0) text += fmt::format(" --seed {}", q.seed);
  if (q.quick) text += " --quick";
  if (q.runs > 0) text += fmt::format(" --runs {}", q.runs);
  if (!q.speeds_m_s.empty()) text += fmt::format(" --speeds {}", fmt::join(q.speeds_m_s, ","));
  for (const auto& file : q.scenario_files) text += " --scenario " + file;
  for (const auto& file : q.track_files) text += " --tracks " + file;
  return text;
}

// All are compared, but in experiments that stand apart.
std::vector<std::string> usual_methods(const std::vector<Experiment>& chosen) {
  std::vector<std::string> methods = {std::string(kOurs)};
  for (const Experiment& e : chosen) {
    if (!e.apart) return {std::begin(kMethods), std::end(kMethods)};
    if (!e.methods.empty()) methods = e.methods;
  }
  return methods;
}

void complete(Options& o) {
  auto& chosen = o.request.experiments;
  for (const auto& name : o.names) {
    if (name == "all")
      std::copy_if(experiments().begin(), experiments().end(), std::back_inserter(chosen),
                   [](const Experiment& e) { return !e.apart; });
    else
      chosen.push_back(experiment_named(name));
  }
  o.request.methods = o.methods.empty() ? usual_methods(chosen) : o.methods;
  if (!o.request.scenario_files.empty())
    std::erase_if(o.request.experiments,
                  [](const Experiment& e) { return e.event == EventKind::kWalk; });
  o.request.maps.clear();
  for (const auto& map : o.maps)
    o.request.maps.push_back(map == "depth" ? MapSource::kDepth : MapSource::kKnown);
  for (std::size_t i = 0; i < kKeptLogsNames.size(); ++i)
    if (o.logs == kKeptLogsNames[i]) o.bench.logs = static_cast<KeptLogs>(i);
  o.bench.out = o.out;
  o.bench.progress = progress_line();
  std::signal(SIGINT, on_interrupt);
  std::signal(SIGTERM, on_interrupt);
  o.bench.stopped = [] { return interrupted != 0; };
}

int bench_with(Options o) {
  complete(o);
  const BenchResults results = run_bench(o.request, o.bench);
  if (interrupted != 0)
    fmt::print("\ninterrupted: these are the {} flights until then\n", results.jobs.size());
  print_hidings(results.hidings);
  print_fleets(results.fleets);
  if (!results.fleets.empty()) {
    // The cells would tell of the first vehicle alone.
  } else if (results.encounters.empty()) {
    print_cells(results);
  } else {
    print_encounters(results.encounters.by_kind, "kind");
    print_encounters(results.encounters.by_place, "place");
  }
  print_comparisons(results);
  print_failures(results);
  if (o.out.empty()) return 0;
  if (o.report) write_report(o.out, command_of(o) + (interrupted != 0 ? "   (interrupted)" : ""));
  fmt::print("\nwritten to {}\n",
             (o.bench.out / (o.report ? "report.html" : "summary.json")).string());
  return interrupted != 0 ? 130 : 0;
}

// Nothing is flown: people are rendered and told apart.
int tell_people_apart(const BenchRequest& request) {
  IdentityRequest identity;
  if (request.runs > 0) identity.events = request.runs;
  if (request.seed > 0) identity.seed = request.seed;
  std::signal(SIGINT, on_interrupt);
  identity.goes_on = [](int) { return interrupted == 0; };
  fmt::print("{}", table_of(bench_identity(identity)));
  return interrupted != 0 ? 130 : 0;
}

}  // namespace

std::function<int()> prepare_bench(CLI::App& app) {
  const auto o = std::make_shared<Options>();
  BenchRequest& q = o->request;
  app.add_option("NAME", o->names,
                 "turning, deceleration, t_intersection, real_tracks, stress, all of these, or "
                 "chests, real_tracks_chest, encounters, encounters_all_round, search, fleet; or "
                 "identity, alone")
      ->capture_default_str();
  app.add_option("--runs", q.runs,
                 "seeds a world (real_tracks: pedestrians, identity: events) instead of the usual")
      ->check(CLI::Range(1, 100000));
  app.add_option("--seed", q.seed,
                 "the first seed; missing: 5001, encounters 20001, search 31001, identity 45001, "
                 "fleet 51001")
      ->check(CLI::Range(std::uint64_t{1}, std::uint64_t{1} << 53));
  app.add_option("--methods", o->methods,
                 "names of deploy/params, or parameter files, parted by commas; missing: all, "
                 "encounters: intention, chests: intention and filter")
      ->delimiter(',');
  app.add_option("--maps", o->maps, "known, depth")
      ->delimiter(',')
      ->check(CLI::IsMember({"known", "depth"}))
      ->capture_default_str();
  app.add_option("--speeds", q.speeds_m_s, "of the target, m/s, instead of the usual")
      ->delimiter(',')
      ->check(CLI::Range(0.1, 5.0));
  app.add_option("--scenario", q.scenario_files, "own worlds and routes instead of the usual")
      ->check(CLI::ExistingFile);
  app.add_option("--tracks", q.track_files, "track files of real_tracks")->check(CLI::ExistingFile);
  app.add_option("--track-rate", q.track_rate_hz,
                 "their frames a second; missing: as the files say, else 25")
      ->check(CLI::Range(0.01, 1000.0));
  app.add_option("--out", o->out, "folder for summary.json, report.html, plots and logs");
  app.add_option("--logs", o->logs, "which logs are kept: none, failed, all")
      ->check(CLI::IsMember({"none", "failed", "all"}))
      ->capture_default_str();
  app.add_option("--threads", o->bench.threads, "flights at the same time; 0: one a core")
      ->check(CLI::Range(0, 1024))
      ->capture_default_str();
  app.add_flag("--quick", q.quick, "a few minutes instead of hours: fewer and shorter flights");
  app.add_flag("!--no-report", o->report, "leave report.html and the plots out");
  return [o] {
    return o->names == std::vector<std::string>{"identity"} ? tell_people_apart(o->request)
                                                            : bench_with(*o);
  };
}

}  // namespace foretrack
