// SPDX-License-Identifier: Apache-2.0
// Tells the ground who is followed, and asks it who it is, with pictures.
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "core/common/image.hpp"
#include "foretrack_msgs/msg/TargetChoice.h"
#include "services/common/service.hpp"
#include "services/common/topics.hpp"
#include "services/common/writer.hpp"
#include "services/convert/choice.hpp"

namespace foretrack {

/// Writes `target/choice` five times a second, and at once when it changes. Pictures are cut then,
/// from the newest image, of whom it shows: of who was chosen while that is certain, of candidates
/// while they are asked about. Cost: 2 ms a picture.
class ChoiceTeller {
 public:
  explicit ChoiceTeller(Service& service) : service_(service), writer_(service.node()) {}

  /// `image`: the newest, of image_s; null: there are none.
  void tell(double stamp_s, const ChoiceResult& choice, const MovingBodies& bodies,
            std::span<const PersonLook> looks, const RgbImage* image, double image_s);

 private:
  using Jpeg = std::vector<std::uint8_t>;
  bool is_news(const ChoiceResult& choice) const;
  void take_pictures(const ChoiceResult& choice, const MovingBodies& bodies,
                     std::span<const PersonLook> looks, const RgbImage& image, double image_s);

  Service& service_;
  Writer<topics::TargetChoice> writer_;
  ChoiceReport report_;
  std::map<std::uint32_t, Jpeg> candidates_;  // their last pictures
  double told_s_ = -1e9, pictured_s_ = -1e9;
};

}  // namespace foretrack
