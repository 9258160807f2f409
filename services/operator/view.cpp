// SPDX-License-Identifier: Apache-2.0
#include "services/operator/view.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "services/operator/words.hpp"

namespace foretrack {
namespace {

constexpr int kBarCells = 12;

std::string bar(double share, int cells = kBarCells) {
  const int full = static_cast<int>(std::lround(std::clamp(share, 0.0, 1.0) * cells));
  std::string text;
  for (int i = 0; i < cells; ++i) text += i < full ? "█" : "░";
  return text;
}

std::string painted(const ViewOptions& o, bool good, const std::string& text) {
  if (!o.colors) return text;
  return (good ? "\033[32m" : "\033[31m") + text + "\033[0m";
}

std::string age_text(double age_s) {
  return age_s < 0.0 ? "never" : fmt::format("{:.2f} s", age_s);
}

bool is_total(const foretrack_msgs::msg::StageTime& s) {
  return s.stage() == "total";
}

double plan_ms(const FlightSnapshot& p) {
  double sum = 0.0;
  for (const auto& s : p.plan->stage_times())
    if (!is_total(s)) sum += s.ms();
  return sum;
}

std::string person(const FlightSnapshot& p, const ViewOptions& o) {
  if (!p.target) return "not known yet";
  const auto& t = *p.target;
  namespace c = foretrack_msgs::msg::TargetState_Constants;
  return fmt::format(
      "{}  at ({:.1f}, {:.1f}) m  {:.1f} m/s  measured {} ago",
      painted(o, t.status() == c::STATUS_TRACKING, std::string(track_word(t.status()))),
      t.position_m()[0], t.position_m()[1], std::hypot(t.velocity_mps()[0], t.velocity_mps()[1]),
      age_text(t.last_measurement_age_s()));
}

std::string intentions(const FlightSnapshot& p) {
  if (!p.intention) return "not known yet\n";
  std::string text;
  for (const auto& i : p.intention->intentions())
    text += fmt::format("{}{:<12}{} {:.2f}\n", text.empty() ? "" : "           ", i.name().c_str(),
                        bar(i.probability()), i.probability());
  return text.empty() ? "none\n" : text;
}

// A ruler from 0 to twice the band's far end; the band is drawn thick.
std::string distance(const FlightSnapshot& p, const ViewOptions& o) {
  const double d = distance_m(p);
  if (d < 0.0) return "not known yet";
  constexpr int kCells = 40;
  const double end_m = 2.0 * o.distance_high_m;
  const int at = std::clamp(static_cast<int>(d / end_m * kCells), 0, kCells - 1);
  std::string ruler;
  for (int i = 0; i < kCells; ++i) {
    const double x_m = (i + 0.5) / kCells * end_m;
    const bool in_band = x_m >= o.distance_low_m && x_m <= o.distance_high_m;
    ruler += i == at ? "●" : in_band ? "━" : "·";
  }
  const bool good = d >= o.distance_low_m && d <= o.distance_high_m;
  return fmt::format("{}  {}", painted(o, good, fmt::format("{:4.1f} m", d)), ruler);
}

// What the vehicle itself knows of it: the age of the last measurement, the bearing off the nose.
std::string visibility(const FlightSnapshot& p, const ViewOptions& o) {
  if (!p.target || !p.odometry) return "not known yet";
  constexpr double kFresh_s = 0.3;
  const auto& pose = p.odometry->pose().pose();
  const auto& q = pose.orientation();
  const double yaw = std::atan2(2.0 * (q.w() * q.z() + q.x() * q.y()),
                                1.0 - 2.0 * (q.y() * q.y() + q.z() * q.z()));
  const double bearing = std::atan2(p.target->position_m()[1] - pose.position().y(),
                                    p.target->position_m()[0] - pose.position().x());
  const bool seen = p.target->last_measurement_age_s() < kFresh_s;
  return fmt::format("{}  {:+.0f}° off the nose",
                     painted(o, seen, seen ? "the person is seen" : "the person is hidden"),
                     std::remainder(bearing - yaw, 2.0 * M_PI) * 180.0 / M_PI);
}

std::string plan(const FlightSnapshot& p, const ViewOptions& o) {
  if (!p.plan) return "none yet";
  namespace c = foretrack_msgs::msg::PlannedTrajectory_Constants;
  std::string stages;
  for (const auto& s : p.plan->stage_times()) {
    if (is_total(s)) continue;
    stages += fmt::format("  {} {:.1f}", s.stage().c_str(), s.ms());
  }
  const bool good = p.plan->status() == c::STATUS_FRESH;
  std::string why = good ? "" : fmt::format(" ({})", explain_plan(p.plan->reason()));
  return fmt::format("{}{}  {:.1f} ms:{}",
                     painted(o, good, std::string(plan_word(p.plan->status()))), why, plan_ms(p),
                     stages);
}

std::string safety(const FlightSnapshot& p, const ViewOptions& o) {
  if (!p.safety) return "silent";
  const auto& s = *p.safety;
  namespace c = foretrack_msgs::msg::SafetyState_Constants;
  const bool good = s.mode() == c::MODE_TRACK;
  return fmt::format("{}{}  {}  {}  {}", painted(o, good, std::string(mode_word(s.mode()))),
                     good ? "" : fmt::format(" ({})", explain_gate(s.reason())),
                     s.armed() ? "armed" : "not armed", s.offboard() ? "offboard" : "not offboard",
                     s.heartbeat() ? "heartbeat" : "no heartbeat");
}

std::string topics(const FlightSnapshot& p) {
  std::string text =
      fmt::format("{:<22}{:>9}{:>10}{:>9}  {}\n", "topic", "rate", "age", "writers", "rejected");
  for (const auto& f : p.flows) {
    std::uint64_t rejected = 0;
    for (const auto& [reason, count] : f.rejected) rejected += count;
    text += fmt::format("{:<22}{:>6.0f} Hz{:>10}{:>9}  {}\n", f.topic, f.rate_hz, age_text(f.age_s),
                        f.writers, rejected);
  }
  return text;
}

std::string services(const FlightSnapshot& p) {
  std::string text = fmt::format("{:<22}{:>9}{:>10}{:>11}{:>11}\n", "service", "state", "processor",
                                 "memory", "work/loop");
  for (const auto& s : p.services) {
    const auto& h = s.health;
    const bool degraded = h.state() == foretrack_msgs::msg::ServiceHealth_Constants::STATE_DEGRADED;
    text += fmt::format("{:<22}{:>9}{:>8.0f} %{:>8.0f} MB{:>8.1f} ms{}\n", h.service().c_str(),
                        s.age_s > 3.0 ? "silent" : service_word(h.state()), h.cpu_percent(),
                        static_cast<double>(h.rss_bytes()) / 1e6, h.loop_mean_ms(),
                        degraded ? std::string("  ") + h.last_error().c_str() : "");
  }
  return text;
}

}  // namespace

std::string draw(const FlightSnapshot& p, const ViewOptions& o) {
  std::string text =
      fmt::format("foretrack  {}  domain {}  {:.0f} s\n\n", p.vehicle, p.domain, o.elapsed_s);
  text += "person     " + person(p, o) + '\n';
  text += "intention  " + intentions(p);
  text += "distance   " + distance(p, o) + '\n';
  text += "view       " + visibility(p, o) + '\n';
  text += "plan       " + plan(p, o) + '\n';
  text += "gate       " + safety(p, o) + "\n\n";
  text += topics(p) + '\n' + services(p);
  for (const auto& sentence : p.foreign) text += "foreign    " + sentence + '\n';
  return text;
}

std::string status_line(const FlightSnapshot& p, const ViewOptions& o) {
  std::string likely = "?";
  double best = 0.0;
  if (p.intention)
    for (const auto& i : p.intention->intentions())
      if (i.probability() > best) {
        best = i.probability();
        likely = i.name().c_str();
      }
  const double d = distance_m(p);
  return fmt::format("{:5.1f} s  person {}  {} {:.2f}  distance {}  plan {} {:.1f} ms  gate {}",
                     o.elapsed_s, p.target ? track_word(p.target->status()) : "?", likely, best,
                     d < 0.0 ? "?" : fmt::format("{:.1f} m", d),
                     p.plan ? plan_word(p.plan->status()) : "?", p.plan ? plan_ms(p) : 0.0,
                     p.safety ? mode_word(p.safety->mode()) : "?");
}

bool is_terminal() {
  const char* kind = std::getenv("TERM");
  return isatty(STDOUT_FILENO) == 1 && kind && std::strcmp(kind, "dumb") != 0;
}

Screen::Screen() {
  std::fputs("\033[?1049h\033[?25l\033[2J", stdout);
}

Screen::~Screen() {
  std::fputs("\033[?25h\033[?1049l", stdout);
  std::fflush(stdout);
}

void Screen::show(const std::string& text) {
  std::string out = "\033[H";
  for (const char c : text) {
    if (c == '\n') out += "\033[K";
    out += c;
  }
  out += "\033[J";
  std::fwrite(out.data(), 1, out.size(), stdout);
  std::fflush(stdout);
}

}  // namespace foretrack
