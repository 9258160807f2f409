// SPDX-License-Identifier: Apache-2.0
#include "services/onboard/transform_input.hpp"

#include "services/convert/geometry.hpp"
#include "services/convert/transforms.hpp"

namespace foretrack {

template <class Topic>
void TransformInput::take(Reader<Topic>& reader, bool is_static) {
  reader.take_each([&](const tf2_msgs::msg::TFMessage& message) {
    if (const auto fault = take_transforms(message, is_static, tree_)) reader.refuse(*fault);
  });
}

void TransformInput::update() {
  take(static_, true);
  take(moving_, false);
}

std::optional<Pose> TransformInput::in_map(const std::string& frame, double stamp_s,
                                           std::string& why) const {
  auto found = tree_.find(kWorldFrame, frame, stamp_s);
  why = found.why;
  if (found.status != TransformTree::Status::kFound) return std::nullopt;
  return found.T_to_from;
}

}  // namespace foretrack
