// What the onboard services share: messages that are converted or refused, and the vehicle's state.
#pragma once

#include <functional>
#include <string>

#include "core/common/vehicle.hpp"
#include "nav_msgs/msg/Odometry.h"
#include "services/common/service.hpp"
#include "services/convert/vehicle.hpp"

namespace foretrack {

/// Counts a refusal by its field; the first of each field is logged in full.
template <class Topic>
void refuse(Node& node, Reader<Topic>& reader, const Fault& fault) {
  reader.reject(fault.field);
  if (reader.stats().rejected_for(fault.field) == 1)
    node.report(std::string(Topic::info.name) + ": " + fault.text);
}

/// from_idl(message, …), or a counted refusal.
template <class Topic, class Message, class... Args>
auto accept(Node& node, Reader<Topic>& reader, Message&& message, Args&&... args) {
  auto converted = from_idl(std::forward<Message>(message), std::forward<Args>(args)...);
  if (!converted) refuse(node, reader, converted.fault());
  return converted;
}

/// The vehicle's odometry: its newest state and the history that images need.
class VehicleInput {
 public:
  /// `changed` is called after each wake-up that brought samples; may be empty.
  explicit VehicleInput(Service& service, std::function<void()> changed = {});

  const VehicleHistory& history() const { return history_; }
  /// Null: none came yet.
  const VehicleState* newest() const { return history_.newest(); }
  /// By its stamp; infinite if none came yet.
  double age_s(double now_s) const;

 private:
  void add(const VehicleState& state);

  Node& node_;
  Reader<topics::Odometry> reader_;
  VehicleHistory history_;
};

}  // namespace foretrack
