// SPDX-License-Identifier: Apache-2.0
#include "services/onboard/perception/perception_service.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "services/convert/bodies.hpp"
#include "services/convert/prediction.hpp"
#include "services/convert/safety.hpp"
#include "services/convert/target.hpp"
#include "services/convert/visual.hpp"

namespace foretrack {
namespace {

// Found here, where all from_idl are declared.
constexpr auto convert = [](auto&& message) {
  return from_idl(std::forward<decltype(message)>(message));
};

constexpr double kCoastPeriod_s = 1.0 / 30.0;
constexpr std::size_t kMaxWaiting = 8;
constexpr double kDoubt_s = 3.0;  // so long it is said
constexpr char kAmbiguous[] = "several people could be the one who is followed; see the image";

// They are asked for with each picture; whether there are any is decided at the start.
void show_stream(Service& service, StreamParams& live) {
  ParamRows at_start, in_flight;
  for (const ParamRow& row : rows(live))
    (row.name == "enabled" ? at_start : in_flight).push_back(row);
  service.parameters().add("ground_stream", at_start, Change::kAtStart);
  service.parameters().add("ground_stream", in_flight, Change::kInFlight);
}

}  // namespace

PerceptionService::PerceptionService(Service& service, const PerceptionParams& params,
                                     const BodyParams& body_params,
                                     const ChoiceParams& choice_params, const StreamParams& stream)
    : service_(service),
      params_(params),
      body_params_(body_params),
      choice_params_(choice_params),
      vehicle_(service, [this] { perceive_waiting(); }),
      observation_(service.node()),
      sightings_(service.node()),
      prediction_reader_(service.node()),
      gate_reader_(service.node()),
      target_(service.node()),
      bodies_(service.node()),
      choice_teller_(service),
      markers_(service.node()),
      images_(
          service, params, stream, state_, vehicle_, [this](const auto& seen) { take_seen(seen); },
          [this](const PeopleSeen& people) { take_sightings(people.sightings, people.looks); }) {
  images_.start_with(choice_params);
  service.loop().on_each(gate_reader_, [this](const auto& message) {
    const auto gate = from_idl(message);
    gate ? hear_gate(*gate) : gate_reader_.refuse(gate.fault());
  });
  service.loop().on_each(observation_, [this](const auto& message) { take(message); });
  service.loop().on_each(sightings_, convert,
                         [this](const BodySightings& seen) { take_sightings(seen, {}); });
  service.loop().on_newest(prediction_reader_, convert, [this](Prediction&& prediction) {
    prediction_ = std::move(prediction);
  });
  service.loop().every(kCoastPeriod_s, [this] { coast_if_silent(); });
}

void PerceptionService::take(const foretrack_msgs::msg::TargetObservation& message) {
  // Its own ones come back, too.
  if (service_.clock().now_s() - looked_s_ < params_.own_images_s) return;
  if (sees_nobody(message)) return;
  const auto observation = from_idl(message);
  if (!observation) return observation_.refuse(observation.fault());
  wait_for_odometry({*observation, 0.0, std::numeric_limits<double>::quiet_NaN()});
}

void PerceptionService::take_seen(const ImageInput::Seen& seen) {
  looked_s_ = seen.stamp_s;
  if (!seen_) {
    seen_.emplace(service_.node());
    service_.node().announce();
  }
  if (seen.observation) {
    to_idl(*seen.observation, seen_->sample());
    wait_for_odometry({*seen.observation, 0.0, seen.torso_depth_m, true, seen.wears});
  } else {
    to_idl_nobody(seen.stamp_s, seen_->sample());
  }
  seen_->write();
}

void PerceptionService::wait_for_odometry(Waiting observed) {
  if (waiting_.size() == kMaxWaiting) waiting_.pop_front();
  observed.arrived_s = service_.clock().now_s();
  waiting_.push_back(std::move(observed));
  perceive_waiting();
}

// An image may arrive before the odometry of its stamp.
void PerceptionService::perceive_waiting() {
  const double now_s = service_.clock().now_s();
  for (; !waiting_.empty(); waiting_.pop_front()) {
    const auto& [observation, arrived_s, torso_depth_m, own, wears] = waiting_.front();
    const VehicleState* vehicle = vehicle_.newest();
    const bool covered = vehicle && vehicle->stamp_s >= observation.stamp_s;
    if (!covered && now_s - arrived_s < kPoseWait_s) return;
    if (!own && take_as_other(people(), observation, vehicle_.history(), people_params())) continue;
    doubtful_ = observation.doubtful;
    const auto result = perceive(state_, observation, vehicle_.history(), params_, torso_depth_m);
    if (result.status == PerceptionStatus::kGated) ++gated_;
    delay_s_ = std::clamp(now_s - observation.stamp_s, 0.0, params_.delay_max_s);
    if (result.used_landmarks > 0)
      if (auto look = look_of(observation, vehicle_.history(), params_)) {
        look->wear(wears);
        bodies_state_.followed_look = *look;
      }
    if (result.target.stamp_s > published_s_) publish(result.target);
  }
}

void PerceptionService::coast_if_silent() {
  images_.update();
  perceive_waiting();
  const double now_s = service_.clock().now_s();
  const bool seeing = vehicle_.age_s(now_s) < params_.vehicle_stale_s;
  const bool doubtful = std::abs(now_s - images_.ambiguous_s()) < kDoubt_s;
  const std::string blind = images_.sight().trouble("colour");
  service_.health().set_degraded(!seeing                      ? "no odometry"
                                 : !blind.empty()             ? blind
                                 : !images_.trouble().empty() ? images_.trouble()
                                 : doubtful                   ? kAmbiguous
                                                              : images_.mount_trouble());
  if (now_s < published_s_ - kRestart_s) {  // a simulation was started anew
    state_ = {};
    bodies_state_ = {};
    choice_ = {};
    published_s_ = -1.0;
    looked_s_ = -1e9;
  }
  const double to_s = now_s - delay_s_;
  if (to_s - published_s_ < 1.5 * kCoastPeriod_s) return;
  TargetState target = coast(state_, to_s, params_);
  target.stamp_s = std::max(to_s, 0.0);
  publish(target);
}

void PerceptionService::publish(const TargetState& target) {
  to_idl(target, target_.sample());
  target_.sample().rejected_measurements(gated_);
  target_.write();
  publish_bodies(target);
  if (target.status != TrackStatus::kNone) published_s_ = target.stamp_s;
  publish_markers(target);
}

void PerceptionService::take_sightings(const BodySightings& seen,
                                       std::span<const PersonLook> looks) {
  const bool moved =
      foretrack::take_sightings(people(), seen, looks, vehicle_.history(), people_params());
  if (moved && seen.stamp_s > published_s_) publish(coast(state_, seen.stamp_s, params_));
}

// An order acts once, when the gate has taken it. What it remembers of before we began means
// nothing here, as bodies are numbered anew; but that nobody is to be followed.
void PerceptionService::hear_gate(const GateReport& gate) {
  const PersonChoice& person = gate.result.person;
  const bool is_follow =
      gate.order == MissionOrder::kFollow && is_accepted(gate.result.command_result);
  const bool is_new = is_follow && gate.result.command_id != order_id_;
  const bool changed = ordered_ ? person != *ordered_ : person.made && person.person_id == 0;
  if (is_follow) order_id_ = gate.result.command_id;
  if (person.made && (changed || (is_new && ordered_))) order_ = person.person_id;
  ordered_ = person;
}

void PerceptionService::choose_whom(double stamp_s) {
  const VehicleState* vehicle = vehicle_.newest();
  const ChoiceResult choice =
      choose_person(people(),
                    {.now_s = stamp_s,
                     .bodies = around_,
                     .looks = looks_,
                     .vehicle_enu_m = vehicle ? vehicle->position_enu_m : Vec3(Vec3::Zero()),
                     .doubtful = std::exchange(doubtful_, false),
                     .order = std::exchange(order_, std::nullopt)},
                    people_params());
  if (choice.take_over)
    *choice.take_over == 0 ? images_.follow_nobody() : images_.follow(choice_.wears);
  choice_teller_.tell(stamp_s, choice, around_, looks_, images_.image(), images_.image_s());
}

void PerceptionService::publish_bodies(const TargetState& target) {
  const VehicleState* vehicle = vehicle_.newest();
  const double stamp_s = std::max(target.stamp_s, bodies_state_.newest_s);
  bodies_around(bodies_state_, stamp_s, {target, &prediction_, params_.target_height_m},
                vehicle ? vehicle->position_enu_m : Vec3(Vec3::Zero()), body_params_, around_,
                looks_);
  to_idl(around_, looks_, bodies_.sample());
  bodies_.sample().camera(static_cast<std::uint8_t>(images_.sight().fault()));
  bodies_.write();
  choose_whom(stamp_s);
}

void PerceptionService::publish_markers(const TargetState& target) {
  if (markers_.readers() == 0 || !drawing_.is_due(service_.clock().now_s())) return;
  to_markers(target, markers_.sample());
  markers_.write();
}

void run_perception(const ServiceOptions& options, const PerceptionParams& params,
                    const BodyParams& body_params, const ChoiceParams& choice_params,
                    const StreamParams& stream, Stop& stop) {
  Service service("perception", options, stop);
  service.show("perception", params);
  service.show("bodies", body_params);
  service.show("choice", choice_params);
  StreamParams live = stream;
  show_stream(service, live);
  PerceptionService stage(service, params, body_params, choice_params, live);
  service.run();
}

}  // namespace foretrack
