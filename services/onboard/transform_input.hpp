// SPDX-License-Identifier: Apache-2.0
// tf and tf_static in: where frames are.
#pragma once

#include <optional>
#include <string>

#include "core/common/transform_tree.hpp"
#include "services/common/service.hpp"
#include "tf2_msgs/msg/TFMessage.h"

namespace foretrack {

class TransformInput {
 public:
  explicit TransformInput(Service& service)
      : service_(service), moving_(service.node()), static_(service.node()) {}

  /// Takes all that came. Call it at 10 Hz or more: readers keep few samples.
  void update();
  /// The newest that came is in it.
  const TransformTree& tree() const { return tree_; }
  /// T_map_frame; none: `why` says why.
  std::optional<Pose> in_map(const std::string& frame, double stamp_s, std::string& why) const;

 private:
  template <class Topic>
  void take(Reader<Topic>& reader, bool is_static);

  Service& service_;
  Reader<topics::Transforms> moving_;
  Reader<topics::StaticTransforms> static_;
  TransformTree tree_;
};

}  // namespace foretrack
