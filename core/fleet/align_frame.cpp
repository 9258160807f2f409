// SPDX-License-Identifier: Apache-2.0
#include "core/fleet/align_frame.hpp"

#include <algorithm>

namespace foretrack {
namespace {

constexpr double kPairs_s = 0.1;        // least time between two pairs
constexpr double kCorrelation_s = 1.0;  // so long the errors of estimates hold
constexpr double kLeastSigma_m = 0.05;  // of a pair, whatever the residuals say
constexpr double kLeastPairs = 3.0;     // independent ones

double cross(const Vec3& a, const Vec3& b) {
  return a.x() * b.y() - a.y() * b.x();
}

Eigen::Matrix3d turn_of(double yaw_rad) {
  return Eigen::AngleAxisd(yaw_rad, Vec3::UnitZ()).toRotationMatrix();
}

// The seats' directions turn with the frame, to the nearest sector.
void turn_bids(FleetMember& member, double yaw_rad) {
  const int steps = static_cast<int>(std::lround(yaw_rad * kSeatSectors / (2.0 * kPi)));
  const auto turned = [&](Seat seat) {
    return Seat::of(((seat.sector() + steps) % kSeatSectors + kSeatSectors) % kSeatSectors,
                    seat.ring());
  };
  const auto bids = member.bids;
  for (int i = 0; i < kSeatCount; ++i)
    member.bids[turned({static_cast<std::int8_t>(i)}).number] = bids[i];
  if (!member.seat.is_none()) member.seat = turned(member.seat);
}

void place_person(FleetPerson& person, const FrameAlignment& a, const Mat3& turn) {
  person.position_enu_m = a.place(person.position_enu_m);
  person.velocity_enu_m_s = turn * person.velocity_enu_m_s;
  Mat6 both = Mat6::Zero();
  both.topLeftCorner<3, 3>() = both.bottomRightCorner<3, 3>() = turn;
  person.covariance = both * person.covariance * both.transpose();
  person.covariance.topLeftCorner<3, 3>().diagonal().array() +=
      a.position_sigma_m * a.position_sigma_m;
}

}  // namespace

Vec3 FrameAlignment::turned(const Vec3& theirs) const {
  return turn_of(yaw_rad) * theirs;
}

void add_pair(AlignmentSums& s, double stamp_s, const Vec3& theirs_m, const Vec3& ours_m,
              const FleetParams& params) {
  if (stamp_s < s.stamp_s + kPairs_s) return;
  const double kept =
      s.weight > 0.0 ? std::exp((s.stamp_s - stamp_s) / params.align_memory_s) : 0.0;
  s.stamp_s = stamp_s;
  for (double* sum : {&s.weight, &s.theirs_m2, &s.ours_m2, &s.dot_m2, &s.cross_m2}) *sum *= kept;
  const Vec3 p = theirs_m - s.theirs_m, q = ours_m - s.ours_m;
  const double share = s.weight / (s.weight + 1.0);
  s.weight += 1.0;
  s.theirs_m += p / s.weight;
  s.ours_m += q / s.weight;
  s.theirs_m2 += share * p.head<2>().squaredNorm();
  s.ours_m2 += share * q.head<2>().squaredNorm();
  s.dot_m2 += share * p.head<2>().dot(q.head<2>());
  s.cross_m2 += share * cross(p, q);
}

FrameAlignment align_frame(const AlignmentSums& s) {
  FrameAlignment out;
  const double independent = s.weight * kPairs_s / kCorrelation_s;
  if (independent < kLeastPairs) return out;
  out.yaw_rad = std::atan2(s.cross_m2, s.dot_m2);
  out.shift_m = s.ours_m - turn_of(out.yaw_rad) * s.theirs_m;
  const double rest_m2 =
      std::max(s.theirs_m2 + s.ours_m2 - 2.0 * std::hypot(s.dot_m2, s.cross_m2), 0.0);
  const double sigma_m =
      std::max(std::sqrt(rest_m2 / (2.0 * s.weight)), kLeastSigma_m);  // of one axis of a pair
  const double spread_m2 = std::max(s.theirs_m2 * kPairs_s / kCorrelation_s, 1e-9);
  out.yaw_sigma_rad = std::min(sigma_m / std::sqrt(spread_m2), kPi);
  out.position_sigma_m = sigma_m * std::sqrt(1.0 / independent) +
                         out.yaw_sigma_rad * std::sqrt(s.theirs_m2 / s.weight);
  return out;
}

FleetMember in_our_frame(FleetMember member, const FrameAlignment& a) {
  const Mat3 turn = turn_of(a.yaw_rad);
  member.position_enu_m = a.place(member.position_enu_m);
  member.velocity_enu_m_s = turn * member.velocity_enu_m_s;
  member.yaw_rad = wrap_angle(member.yaw_rad + a.yaw_rad);
  for (int i = 0; i < member.plan.count; ++i) {
    auto& c = member.plan.pieces[i].coefficients;
    c = (c * turn.transpose()).eval();
    c.row(0) += a.shift_m.transpose();
  }
  for (int i = 0; i < member.person_count; ++i) place_person(member.persons[i], a, turn);
  turn_bids(member, a.yaw_rad);
  return member;
}

}  // namespace foretrack
