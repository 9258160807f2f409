// SPDX-License-Identifier: Apache-2.0
#include "services/offline/flight/flight_row.hpp"

#include <fmt/format.h>
#include <openssl/evp.h>

#include <stdexcept>

#include "core/prediction/intentions/intention_table.hpp"

namespace foretrack {
namespace {

// Appends the fields of one row, or their names for the header.
class Line {
 public:
  Line(fmt::memory_buffer& out, bool header) : out_(out), header_(header) {}
  ~Line() { *(out_.end() - 1) = '\n'; }
  Line(const Line&) = delete;
  Line& operator=(const Line&) = delete;

  void number(std::string_view name, double value, int decimals = 4) {
    if (header_) return word(name, {});
    // Minus zero prints as zero.
    if (std::abs(value) < 0.5 * std::pow(10.0, -decimals)) value = 0.0;
    fmt::format_to(std::back_inserter(out_), "{:.{}f},", value, decimals);
  }
  void count(std::string_view name, std::uint64_t value) {
    if (header_) return word(name, {});
    fmt::format_to(std::back_inserter(out_), "{},", value);
  }
  void word(std::string_view name, std::string_view value) {
    fmt::format_to(std::back_inserter(out_), "{},", header_ ? name : value);
  }
  void point(std::string_view name, const Vec2& v) {
    number(std::string(name) + "_x", v.x());
    number(std::string(name) + "_y", v.y());
  }
  void point(std::string_view name, const Vec3& v) {
    point(name, Vec2(v.head<2>()));
    number(std::string(name) + "_z", v.z());
  }

 private:
  fmt::memory_buffer& out_;
  bool header_;
};

std::string_view name_of(TrackStatus status) {
  constexpr std::array<std::string_view, 4> names = {"none", "tracking", "coasting", "lost"};
  return names.at(static_cast<std::size_t>(status));
}

void write_truth(Line& line, const FlightRow& r) {
  line.number("now_s", r.now_s, 3);
  line.point("vehicle", r.vehicle.position_enu_m);
  line.point("vehicle_v", r.vehicle.velocity_enu_m_s);
  line.point("vehicle_a", r.acceleration_enu_m_s2);
  line.number("vehicle_yaw", r.vehicle.yaw_rad());
  line.number("vehicle_yaw_rate", r.vehicle.angular_velocity_body_rad_s.z());
  line.point("target", r.target.position_enu_m);
  line.point("target_v", Vec2(r.target.velocity_enu_m_s.head<2>()));
  line.number("target_body_yaw", r.target.body_yaw_rad);
  line.number("distance", r.distance_m());
  line.number("clearance", r.clearance_m);
  line.count("in_view", r.sight.in_view);
  line.count("unhidden", r.sight.unhidden);
  line.count("offboard", r.autopilot.offboard);
}

void write_belief(Line& line, const FlightRow& r) {
  line.word("track", name_of(r.estimate.status));
  line.number("estimate_stamp_s", r.estimate.stamp_s, 3);
  line.point("estimate", r.estimate.position_enu_m);
  line.point("estimate_v", Vec2(r.estimate.velocity_enu_m_s.head<2>()));
  line.number("estimate_body_yaw", r.estimate.body_yaw_rad);
  for (const IntentionRow& i : kIntentions)
    line.number(fmt::format("p_{}", i.name), r.beliefs[index_of(i.id)].probability);
  for (const IntentionRow& i : kIntentions)
    line.number(fmt::format("score_{}", i.name), r.beliefs[index_of(i.id)].score);
  for (std::size_t i = 0; i < kForesight_s.size(); ++i)
    line.point(fmt::format("ahead_{:.1f}s", kForesight_s[i]), r.foresight_m[i]);
}

void write_decision(Line& line, const FlightRow& r) {
  line.count("planned", r.planned);
  line.word("plan_status", to_string(r.plan_status));
  line.word("plan_reason", to_string(r.plan_reason));
  line.count("plan_id", r.plan_id);
  line.word("mode", r.mode);
  const Setpoint s = r.setpoint.value_or(Setpoint{});
  line.count("commanded", r.setpoint.has_value());
  line.point("setpoint", s.position_enu_m);
  line.point("setpoint_v", s.velocity_enu_m_s);
  line.point("setpoint_a", s.acceleration_enu_m_s2);
  line.number("setpoint_yaw", s.yaw_rad);
  line.number("setpoint_yaw_rate", s.yaw_rate_rad_s);
}

void write_line(fmt::memory_buffer& out, const FlightRow& row, bool header) {
  Line line(out, header);
  write_truth(line, row);
  write_belief(line, row);
  write_decision(line, row);
}

}  // namespace

std::string csv_of(const std::vector<FlightRow>& rows) {
  fmt::memory_buffer out;
  write_line(out, FlightRow{}, true);
  for (const auto& row : rows) write_line(out, row, false);
  return fmt::to_string(out);
}

std::string sha256_of(std::string_view bytes) {
  unsigned char digest[EVP_MAX_MD_SIZE];
  unsigned int size = 0;
  if (EVP_Digest(bytes.data(), bytes.size(), digest, &size, EVP_sha256(), nullptr) != 1)
    throw std::runtime_error("SHA-256 is not available in this OpenSSL");
  std::string text;
  for (unsigned int i = 0; i < size; ++i) text += fmt::format("{:02x}", digest[i]);
  return text;
}

}  // namespace foretrack
