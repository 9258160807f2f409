// SPDX-License-Identifier: Apache-2.0
// Operators' orders to vehicles: leases, commands, and what the safety gates make of them.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "core/safety/mission.hpp"
#include "services/common/node.hpp"
#include "services/common/raw.hpp"
#include "services/ground_station/control/delivery.hpp"
#include "services/ground_station/status.hpp"

namespace foretrack::station {

/// Orders go out as MissionCommand; the gate decides and tells in SafetyState. A lease that an
/// operator takes here lasts a minute and is renewed by taking it again or by any command; while it
/// lasts, the station keeps the gate's short lease alive. An order that the gate has not answered
/// within a second is `unconfirmed`, sent once more, and a reason to join the bus anew; STOP is
/// sent ten times a second until the vehicle has stopped. Belongs to one thread; `now_s` is the
/// steady clock's. Where DDS-Security lets the station write no orders, it says so, and reads on.
class Commander {
 public:
  /// `may_order`: else it only listens. `on_writer` is told the name on the wire of each topic that
  /// it begins to write.
  Commander(std::shared_ptr<Node> node, bool may_order,
            std::function<void(const std::string&)> on_writer);
  ~Commander();

  /// From now on writes by this node. Leases go on; orders that wait for an answer are sent anew, a
  /// STOP by the former node, too.
  void move_to(std::shared_ptr<Node> node);

  /// Called when a gate that is heard does not answer: it may have forgotten who writes.
  std::function<void(const std::string& why)> on_unanswered;

  /// A sample of a vehicle's safety/state.
  void hear(const std::string& vehicle, const CdrBytes& safety_state, double now_s);
  /// Sends what is due, answers what has waited too long. Call it every 20 ms.
  void tick(double now_s);

  void take(const std::string& vehicle, const std::string& name, double now_s, Report report);
  void release(const std::string& vehicle, const std::string& name, double now_s, Report report);
  /// From its holder to another operator, without a moment in which a third one could take it.
  void hand_over(const std::string& vehicle, const std::string& name, const std::string& to,
                 double now_s, Report report);
  /// What its operator_name orders. Needs the lease, but for stop, which goes on, for a minute,
  /// after it was reported unconfirmed, and for land while nobody holds it.
  void command(const std::string& vehicle, const MissionCommand& what, double now_s, Report report);

  std::map<std::string, MissionStatus> missions(double now_s) const;

 private:
  struct Lease {
    std::string name;
    Delivery::Key key;
    double until_s = 0.0;
    double renewed_s = -1e9;
  };
  struct Vehicle {
    std::optional<Delivery> delivery;  // none: nothing was heard, or it may not order
    std::string refused;               // why DDS lets us write nothing to it
    std::optional<Lease> lease;        // that was taken here
    MissionStatus mission;
    double heard_s = 0.0;  // when mission was heard
  };
  Vehicle* find(const std::string& vehicle, const Report& report);
  std::unique_ptr<RawWriter> make_writer(const std::string& name, Vehicle& vehicle);
  void renew(Vehicle& vehicle, double now_s);
  void forget_former();

  std::shared_ptr<Node> node_, former_node_;
  bool may_order_;
  std::function<void(const std::string&)> on_writer_;
  std::map<std::string, Vehicle> vehicles_;
};

}  // namespace foretrack::station
