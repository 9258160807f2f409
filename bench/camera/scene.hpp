// SPDX-License-Identifier: Apache-2.0
// One rendered person, one camera, one perception.
#pragma once

#include <cmath>

#include "bench/camera/walks.hpp"
#include "core/simulator/color_camera.hpp"

namespace foretrack {

/// Houses all around, so that the person is before walls, sky and edges.
World square_of_houses(Random& random);

struct Scene {
  const WalkCase& walk;
  PoseNetwork& network;
  PerceptionParams params;
  WalkScores& scores;
  World world;
  Person person;
  ColorCamera camera;
  DepthCamera depth;
  PoseState eye{};
  PerceptionState filter{}, filter_with_depth{};
  VehicleHistory vehicles{};
  VehicleState vehicle{};

  Scene(const WalkCase& w, PoseNetwork& n, const PerceptionParams& p, WalkScores& s, World where,
        const std::vector<Vec2>& route);

  void look_from(const Vec3& eye_m, double yaw_rad, double roll_rad, double pitch_rad);

  enum class View { kWhole, kPart, kNone };  // part: the head and the torso, at least
  View view() const;

  /// Renders, and looks at the image.
  PoseResult see();

  /// What was seen goes into the filters; its errors are noted. The first filter's result.
  PerceptionResult measure(const PoseResult& result);

  /// Walks on, and calls back at each image's time.
  template <class Aim>
  void run(Aim aim) {
    constexpr double kStep_s = 0.01, kFrame_s = 1.0 / 30.0;
    double next_s = 0.0;
    while (person.state.stamp_s < walk.seconds) {
      advance(person, kStep_s);
      for (Bystander& other : camera.bystanders) advance(other.person, kStep_s);
      if (person.state.stamp_s < next_s) continue;
      next_s += kFrame_s;
      aim(person.state);
    }
  }

 private:
  void note(const PerceptionResult& out, PoseErrors& errors) const;
};

}  // namespace foretrack
