// SPDX-License-Identifier: Apache-2.0
// A colour camera that sees the world, the sky and the person, with depth from the same pass.
#pragma once

#include <memory>

#include "core/common/vehicle.hpp"
#include "core/simulator/depth_camera.hpp"
#include "core/simulator/person.hpp"
#include "core/simulator/person_model.hpp"
#include "core/simulator/scenery.hpp"

namespace foretrack {

/// The camera that renders.
struct ColorCameraParams {
  CameraModel camera;
  double rate_hz = 30.0;
};

/// One rendered image.
struct ColorImage {
  double stamp_s = 0.0;  ///< when it was taken
  CameraModel camera;
  RgbImage pixels;
};

/// Who is rendered beside the person who is followed.
struct Bystander {
  std::shared_ptr<const PersonModel> model;
  Person person;
};

/// A camera with what it renders and the last image.
struct ColorCamera {
  ColorCameraParams params;
  std::shared_ptr<const PersonModel> person;  ///< who is followed
  Scenery scenery;
  Canvas canvas;  ///< of the last image, with its depths
  ColorImage image;
  double next_image_s = 0.0;          ///< when one is due
  std::vector<Corner> posed, shadow;  ///< workspace
  std::vector<Bystander> bystanders;  ///< the caller moves them
};

/// A camera in a world. Throws std::invalid_argument without a person.
ColorCamera make_color_camera(const ColorCameraParams& params, const World& world,
                              std::shared_ptr<const PersonModel> person);

/// Renders what the camera sees from the vehicle at its stamp: the image, and in the canvas the
/// depths. Cost: about 10 ms for 640 × 480 pixels.
void render(ColorCamera& camera, const VehicleState& vehicle, const PersonState& person,
            double height_m);

/// The new image if one is due now, else null. Valid until the next call.
const ColorImage* image_color(ColorCamera& camera, const VehicleState& vehicle,
                              const PersonState& person, double height_m);

/// What a depth camera at the same place measures in the same instant: the depths of the last
/// render() along its own rays, with its own noise. Where there is sky: twice its range. Rays that
/// leave the colour image have no return. Null if no image of the depth camera is due. Valid until
/// its next image.
const DepthImage* depth_of(const ColorCamera& camera, DepthCamera& depth);

}  // namespace foretrack
