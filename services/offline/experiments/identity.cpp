// SPDX-License-Identifier: Apache-2.0
#include "services/offline/experiments/identity.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "core/common/random.hpp"
#include "core/perception/appearance.hpp"
#include "core/perception/measure_height.hpp"
#include "core/simulator/color_camera.hpp"
#include "services/offline/people/load_person.hpp"

namespace foretrack {
namespace {

constexpr double kFrame_s = 0.2;
constexpr double kHeight_m = 1.75, kHeightSigma_m = 0.07;
constexpr double kSeen = 0.5;  // visibility of a joint
constexpr double kNoise_px = 2.0;
constexpr double kLearnt = 0.2;  // of a look, in what is known of a tracked body
constexpr std::uint32_t kFirstId = 1;
constexpr std::uint64_t kHeightsPart = 0x68656967687473;  // of the seed

using Model = std::shared_ptr<const PersonModel>;

/// One of the two on the stage.
struct Actor {
  Model model;
  PersonState state;
  double turn_rad_s = 0.0;
  std::uint32_t id = 0;
  double height_m = kHeight_m;
  bool here = false, followed = false;
  std::optional<Appearance> look, mean;
};

/// Light and camera of one part of an event.
struct Exposure {
  std::array<double, 3> gain{1.0, 1.0, 1.0};
};

class Stage {
 public:
  Stage(std::vector<Model> models, const ChoiceParams& params)
      : models_(std::move(models)),
        params_(params),
        camera_(make_color_camera({}, {}, models_[0])) {}

  void play(std::uint64_t seed, IdentityCell& cell) {
    begin(seed, cell.same);
    appear(person_);
    person_.followed = true;
    person_.id = kFirstId;
    run(4.0);
    cell.kind == IdentityEvent::kMeeting ? meet() : leave_and_return(cell.kind);
    judge(cell);
  }

 private:
  void begin(std::uint64_t seed, bool same) {
    random_ = Random(seed);
    state_ = {};
    now_s_ = 100.0;
    asked_ = false;
    const int count = static_cast<int>(models_.size());
    const int first = random_.integer(0, count - 1);
    const int other = same ? first : (first + random_.integer(1, count - 1)) % count;
    person_ = other_ = {};
    person_.model = models_[static_cast<std::size_t>(first)];
    other_.model = models_[static_cast<std::size_t>(other)];
    // Drawn of their own, so that the rest of an event is as it was when all were as tall.
    Random heights(seed ^ kHeightsPart);
    person_.height_m += heights.normal(0.0, kHeightSigma_m);
    other_.height_m = same ? person_.height_m : kHeight_m + heights.normal(0.0, kHeightSigma_m);
    vehicle_ = {};
    vehicle_.position_enu_m = {0.0, 0.0, random_.uniform(1.2, 2.2)};
    vehicle_.q_world_body = Quat(Eigen::AngleAxisd(random_.uniform(-kPi, kPi), Vec3::UnitZ()));
    expose();
  }

  void expose() {
    const double brightness = random_.uniform(0.7, 1.3);
    for (double& gain : exposure_.gain) gain = brightness * random_.uniform(0.95, 1.05);
  }

  // In the middle of the image or at its left or right (aside −1, 0, 1), looking anywhere.
  void appear(Actor& actor, double aside = 0.0) {
    const double range_m = random_.uniform(2.5, 5.5);
    const Vec2 place(range_m, -aside * 0.3 * range_m);
    actor.here = true;
    actor.mean.reset();
    actor.state.position_enu_m = vehicle_.q_world_body * Vec3(place.x(), place.y(), 0.0);
    actor.state.position_enu_m.z() = torso_height_m(actor.height_m);
    actor.state.body_yaw_rad = random_.uniform(-kPi, kPi);
    actor.state.velocity_enu_m_s.head<2>() =
        random_.uniform(0.0, 1.5) * direction_of(actor.state.body_yaw_rad);
    actor.turn_rad_s = random_.uniform(-0.6, 0.6);
  }

  void meet() {
    other_.id = kFirstId + 1;
    appear(other_);
    other_.state.position_enu_m =
        person_.state.position_enu_m + Vec3(0.4, 0.3, 0.0);  // whatever their order
    doubtful_ = true;
    run(1.0, false);
    doubtful_ = false;
    if (random_.chance(0.5)) {  // the track went on with the other one
      std::swap(person_.followed, other_.followed);
      std::swap(person_.id, other_.id);
    }
    const double side = random_.chance(0.5) ? 1.0 : -1.0;
    appear(person_, side);
    appear(other_, -side);
    run(4.0);
  }

  void leave_and_return(IdentityEvent kind) {
    person_.here = person_.followed = false;
    run(3.0);
    now_s_ += random_.uniform(60.0, 300.0);
    run(1.0);
    expose();
    const bool both = kind == IdentityEvent::kBothReturn;
    const double side = !both ? 0.0 : random_.chance(0.5) ? 1.0 : -1.0;
    person_.id = kFirstId + 2;
    other_.id = kFirstId + 3;
    if (kind != IdentityEvent::kStranger) appear(person_, side);
    if (kind != IdentityEvent::kReturn) appear(other_, -side);
    run(4.0);
  }

  // The operator who is asked answers well, so an event ends with the question.
  void judge(IdentityCell& cell) const {
    ++cell.events;
    cell.asked += asked_;
    if (asked_) return;
    cell.wrong += other_.followed;
    cell.missed += cell.kind != IdentityEvent::kStranger && !person_.followed && !other_.followed;
  }

  void run(double for_s, bool looks = true) {
    for (int i = 0; i < static_cast<int>(for_s / kFrame_s + 0.5) && !asked_; ++i) {
      now_s_ += kFrame_s;
      for (Actor* actor : {&person_, &other_}) move(*actor);
      if (looks && (person_.here || other_.here)) film();
      choose_now(looks);
    }
  }

  static void move(Actor& actor) {
    actor.state.body_yaw_rad += actor.turn_rad_s * kFrame_s;
    actor.state.stride_rad += actor.state.velocity_enu_m_s.norm() * 4.0 * kFrame_s;
  }

  void film() {
    const Actor& first = person_.here ? person_ : other_;
    camera_.person = first.model;
    camera_.bystanders.clear();
    if (person_.here && other_.here) {
      Person person;
      person.params.height_m = other_.height_m;
      person.state = other_.state;
      camera_.bystanders.push_back({other_.model, person});
    }
    vehicle_.stamp_s = now_s_;
    render(camera_, vehicle_, first.state, first.height_m);
    auto& rgb = camera_.image.pixels.rgb;
    for (std::size_t i = 0; i < rgb.size(); ++i)
      rgb[i] = static_cast<std::uint8_t>(std::min(255.0, exposure_.gain[i % 3] * rgb[i]));
    for (Actor* actor : {&person_, &other_}) look_at(*actor);
  }

  void look_at(Actor& actor) {
    actor.look.reset();
    if (!actor.here) return;
    const Pose T_camera_world =
        (vehicle_.T_world_body() * camera_.params.camera.T_body_camera).inverse();
    const auto joints = joints_enu_m(actor.state, actor.height_m);
    PersonPose pose;
    for (int k = 0; k < kLandmarkCount; ++k) {
      const auto px = camera_.params.camera.project(T_camera_world * joints[k]);
      if (!px) return;
      pose.landmarks[k].image_px =
          *px + Vec2(random_.normal(0.0, kNoise_px), random_.normal(0.0, kNoise_px));
      pose.landmarks[k].visibility = 1.0;
    }
    actor.look = appearance_of(camera_.image.pixels, pose);
    if (!actor.look) return;
    actor.look->height_m =
        measure_height(pose.landmarks, camera_.params.camera, T_camera_world.inverse(), 0.0, kSeen)
            .value_or(PersonLook::kNaN);
    if (actor.mean)
      learn(*actor.mean, *actor.look, kLearnt);
    else
      actor.mean = actor.look;
  }

  void add(const Actor& actor, bool looks) {
    if (!actor.here) return;
    PersonLook& look = looks_[bodies_.count] = {};
    if (looks) look.stamp_s = now_s_;
    if (looks) look.wears = actor.followed ? actor.look : actor.mean;
    MovingBody body{.id = actor.id, .kind = BodyKind::kPerson, .followed = actor.followed};
    body.stamp_s = now_s_;
    body.position_enu_m << actor.state.position_enu_m.head<2>(), 0.0;
    bodies_.add(body);
  }

  void choose_now(bool looks) {
    bodies_ = {};
    for (const bool followed : {true, false})
      for (const Actor* actor : {&person_, &other_})
        if (actor->followed == followed) add(*actor, looks);
    const ChoiceResult result = choose(state_,
                                       {.now_s = now_s_,
                                        .bodies = bodies_,
                                        .looks = looks_,
                                        .vehicle_enu_m = vehicle_.position_enu_m,
                                        .doubtful = doubtful_,
                                        .order = {}},
                                       params_);
    asked_ = result.status == ChoiceStatus::kDoubtful;
    if (!result.take_over) return;
    for (Actor* actor : {&person_, &other_}) {
      const bool was = std::exchange(actor->followed, actor->id == *result.take_over);
      if (was) actor->id = *result.take_over;
    }
    for (Actor* actor : {&person_, &other_})
      if (actor->followed) actor->id = kFirstId;
  }

  std::vector<Model> models_;
  ChoiceParams params_;
  ColorCamera camera_;
  Random random_{1};
  VehicleState vehicle_;
  Exposure exposure_;
  Actor person_, other_;
  ChoiceState state_;
  MovingBodies bodies_;
  std::array<PersonLook, MovingBodies::kCapacity> looks_;
  double now_s_ = 0.0;
  bool doubtful_ = false, asked_ = false;
};

IdentityCell& cell_of(std::vector<IdentityCell>& cells, IdentityEvent kind, bool same) {
  for (IdentityCell& cell : cells)
    if (cell.kind == kind && cell.same == same) return cell;
  return cells.emplace_back(IdentityCell{kind, same});
}

double percent(int part, int whole) {
  return whole == 0 ? 0.0 : 100.0 * part / whole;
}

}  // namespace

std::vector<IdentityCell> bench_identity(const IdentityRequest& request) {
  std::vector<Model> models;
  for (const char* name : {"boy", "girl", "man", "suit"}) models.push_back(load_person(name));
  Stage stage(models, request.params);
  std::vector<IdentityCell> cells;
  constexpr std::array kAlike = {IdentityEvent::kMeeting, IdentityEvent::kBothReturn};
  for (int i = 0; i < request.events; ++i) {
    if (request.goes_on && !request.goes_on(i)) break;
    const bool same = i % 3 == 0;
    const auto kind = same ? kAlike[static_cast<std::size_t>(i / 3 % 2)]
                           : static_cast<IdentityEvent>((i / 3 + i % 3) % 4);
    stage.play(request.seed + static_cast<std::uint64_t>(i), cell_of(cells, kind, same));
  }
  std::ranges::sort(cells, {}, [](const IdentityCell& c) { return std::pair(c.same, c.kind); });
  return cells;
}

std::string table_of(const std::vector<IdentityCell>& cells) {
  std::string text = fmt::format("{:<10}{:<10}{:>8}{:>8}{:>8}{:>8}\n", "event", "clothes", "events",
                                 "wrong", "asked", "missed");
  IdentityCell all;
  int apart = 0, needless = 0, missed = 0;
  for (const IdentityCell& c : cells) {
    text += fmt::format("{:<10}{:<10}{:>8}{:>8}{:>8}{:>8}\n",
                        kIdentityEventNames[static_cast<std::size_t>(c.kind)],
                        c.same ? "the same" : "others", c.events, c.wrong, c.asked, c.missed);
    all.events += c.events;
    all.wrong += c.wrong;
    apart += c.same ? 0 : c.events;
    needless += c.same ? 0 : c.asked;
    missed += c.missed;
  }
  return text + fmt::format(
                    "wrong person followed {:.2f} % of {}; asked without need {:.1f} % of {}; "
                    "missed {:.1f} %\n",
                    percent(all.wrong, all.events), all.events, percent(needless, apart), apart,
                    percent(missed, all.events));
}

}  // namespace foretrack
