// SPDX-License-Identifier: Apache-2.0
#include "services/convert/target.hpp"

#include <limits>

#include "services/convert/geometry.hpp"

namespace foretrack {
namespace {

namespace kinds = foretrack_msgs::msg::TargetObservation_Constants;
namespace states = foretrack_msgs::msg::TargetState_Constants;
static_assert(kinds::KIND_LANDMARKS == int(TargetObservation::Kind::kLandmarks));
static_assert(kinds::KIND_POSITION == int(TargetObservation::Kind::kPosition));
static_assert(states::STATUS_NONE == int(TrackStatus::kNone));
static_assert(states::STATUS_TRACKING == int(TrackStatus::kTracking));
static_assert(states::STATUS_COASTING == int(TrackStatus::kCoasting));
static_assert(states::STATUS_LOST == int(TrackStatus::kLost));

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kImage_px = 1e5;
constexpr double kBody_m = 10.0;

// On the wire an unknown yaw is one with a negative variance, in core it is NaN.
template <class Core, class Msg>
void set_body_yaw(const Core& in, Msg& out) {
  const bool known = std::isfinite(in.body_yaw_rad);
  out.body_yaw_rad(known ? in.body_yaw_rad : 0.0);
  out.body_yaw_variance_rad2(known ? in.body_yaw_variance_rad2 : -1.0);
}
template <class Msg, class Core>
void read_body_yaw(Checks& checks, const Msg& in, Core& out) {
  checks.within("body_yaw_variance_rad2", in.body_yaw_variance_rad2(), limits::kVariance);
  if (in.body_yaw_variance_rad2() < 0.0) {
    out.body_yaw_rad = kNaN;
    return;
  }
  checks.within("body_yaw_rad", in.body_yaw_rad(), limits::kAngle_rad);
  out.body_yaw_rad = in.body_yaw_rad();
  out.body_yaw_variance_rad2 = in.body_yaw_variance_rad2();
}

void to_idl(const CameraModel& camera, foretrack_msgs::msg::CameraModel& out) {
  out.width_px(camera.width_px);
  out.height_px(camera.height_px);
  out.fx_px(camera.fx_px);
  out.fy_px(camera.fy_px);
  out.cx_px(camera.cx_px);
  out.cy_px(camera.cy_px);
  set_pose(out.pose_body(), camera.T_body_camera);
}

void read_camera(Checks& checks, const foretrack_msgs::msg::CameraModel& in, CameraModel& out) {
  checks.in_range("camera.width_px", in.width_px(), 1, 16384);
  checks.in_range("camera.height_px", in.height_px(), 1, 16384);
  checks.positive("camera.fx_px", in.fx_px(), kImage_px);
  checks.positive("camera.fy_px", in.fy_px(), kImage_px);
  checks.within("camera.cx_px", in.cx_px(), kImage_px);
  checks.within("camera.cy_px", in.cy_px(), kImage_px);
  check_pose(checks, "camera.pose_body.position", "camera.pose_body.orientation", in.pose_body());
  if (!checks.ok()) return;
  out.width_px = static_cast<int>(in.width_px());
  out.height_px = static_cast<int>(in.height_px());
  out.fx_px = in.fx_px();
  out.fy_px = in.fy_px();
  out.cx_px = in.cx_px();
  out.cy_px = in.cy_px();
  out.T_body_camera = to_pose(in.pose_body());
}

void read_landmarks(Checks& checks, const std::vector<foretrack_msgs::msg::Landmark>& in,
                    std::array<Landmark, kLandmarkCount>& out) {
  checks.count("landmarks", in.size(), kLandmarkCount, kLandmarkCount);
  if (!checks.ok()) return;
  for (int i = 0; i < kLandmarkCount; ++i) {
    const auto& mark = in[i];
    checks.in_range("landmarks.visibility", mark.visibility(), 0.0, 1.0);
    out[i].visibility = mark.visibility();
    if (mark.visibility() == 0.0f) continue;  // its place may be anything
    checks.within("landmarks.image_x_px", mark.image_x_px(), kImage_px);
    checks.within("landmarks.image_y_px", mark.image_y_px(), kImage_px);
    checks.within("landmarks.body_x_m", mark.body_x_m(), kBody_m);
    checks.within("landmarks.body_y_m", mark.body_y_m(), kBody_m);
    checks.within("landmarks.body_z_m", mark.body_z_m(), kBody_m);
    out[i].image_px = {mark.image_x_px(), mark.image_y_px()};
    out[i].body_m = {mark.body_x_m(), mark.body_y_m(), mark.body_z_m()};
  }
}

}  // namespace

void to_idl(const TargetObservation& in, foretrack_msgs::msg::TargetObservation& out) {
  set_header(out.header(), in.stamp_s);
  out.kind(static_cast<std::uint8_t>(in.kind));
  to_idl(in.camera, out.camera());
  const bool landmarks = in.kind == TargetObservation::Kind::kLandmarks;
  out.landmarks().resize(landmarks ? kLandmarkCount : 0);
  for (std::size_t i = 0; i < out.landmarks().size(); ++i) {
    const Landmark& mark = in.landmarks[i];
    auto& row = out.landmarks()[i];
    row.image_x_px(static_cast<float>(mark.image_px.x()));
    row.image_y_px(static_cast<float>(mark.image_px.y()));
    row.visibility(static_cast<float>(mark.visibility));
    row.body_x_m(static_cast<float>(mark.body_m.x()));
    row.body_y_m(static_cast<float>(mark.body_m.y()));
    row.body_z_m(static_cast<float>(mark.body_m.z()));
  }
  out.position_m(to_array(in.position_enu_m));
  out.position_covariance_m2(to_rows<3>(in.covariance_m2));
  set_body_yaw(in, out);
}

void to_idl_nobody(double stamp_s, foretrack_msgs::msg::TargetObservation& out) {
  out = {};
  set_header(out.header(), stamp_s);
  out.kind(kinds::KIND_NONE);
}

bool sees_nobody(const foretrack_msgs::msg::TargetObservation& in) {
  return in.kind() == kinds::KIND_NONE;
}

Converted<TargetObservation> from_idl(const foretrack_msgs::msg::TargetObservation& in) {
  Checks checks;
  TargetObservation out;
  check_header(checks, in.header());
  checks.enumerator("kind", in.kind(), kinds::KIND_POSITION);
  out.stamp_s = seconds(in.header().stamp());
  out.kind = static_cast<TargetObservation::Kind>(in.kind());
  if (out.kind == TargetObservation::Kind::kLandmarks) {
    read_camera(checks, in.camera(), out.camera);
    read_landmarks(checks, in.landmarks(), out.landmarks);
  } else {
    checks.within("position_m", in.position_m(), limits::kPosition_m);
    checks.covariance("position_covariance_m2", in.position_covariance_m2().data(), 3);
    out.position_enu_m = to_vec3(in.position_m());
    out.covariance_m2 = from_rows<3>(in.position_covariance_m2());
    read_body_yaw(checks, in, out);
  }
  return checks.result(std::move(out));
}

void to_idl(const TargetState& in, foretrack_msgs::msg::TargetState& out) {
  set_header(out.header(), in.stamp_s);
  out.status(static_cast<std::uint8_t>(in.status));
  out.position_m(to_array(in.position_enu_m));
  out.velocity_mps(to_array(in.velocity_enu_m_s));
  out.covariance(to_rows<6>(in.covariance));
  set_body_yaw(in, out);
  out.last_measurement_age_s(in.stamp_s - in.last_measurement_s);
}

Converted<TargetState> from_idl(const foretrack_msgs::msg::TargetState& in) {
  Checks checks;
  TargetState out;
  check_header(checks, in.header());
  checks.enumerator("status", in.status(), states::STATUS_LOST);
  out.stamp_s = seconds(in.header().stamp());
  out.status = static_cast<TrackStatus>(in.status());
  if (out.status == TrackStatus::kNone) return checks.result(std::move(out));
  checks.within("position_m", in.position_m(), limits::kPosition_m);
  checks.within("velocity_mps", in.velocity_mps(), limits::kSpeed_m_s);
  checks.covariance("covariance", in.covariance().data(), 6);
  checks.in_range("last_measurement_age_s", in.last_measurement_age_s(), -1.0, 1e6);
  out.position_enu_m = to_vec3(in.position_m());
  out.velocity_enu_m_s = to_vec3(in.velocity_mps());
  out.covariance = from_rows<6>(in.covariance());
  out.last_measurement_s = out.stamp_s - in.last_measurement_age_s();
  read_body_yaw(checks, in, out);
  return checks.result(std::move(out));
}

}  // namespace foretrack
