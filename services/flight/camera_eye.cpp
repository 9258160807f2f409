#include "services/flight/camera_eye.hpp"

namespace foretrack {

const TargetObservation* CameraEye::look(const ColorImage* image, double now_s) {
  if (image) {
    result_ = perceive_image(state_, image->pixels, image->stamp_s, network_, params_);
    if (result_.found())
      waiting_.push_back(to_observation(result_.person, image->stamp_s, image->camera, params_));
  }
  if (waiting_.empty() || now_s < waiting_.front().stamp_s + delay_s_ - 1e-9) return nullptr;
  delivered_ = waiting_.front();
  waiting_.pop_front();
  return &delivered_;
}

}  // namespace foretrack
