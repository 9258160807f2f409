// SPDX-License-Identifier: Apache-2.0
// Operators' orders to vehicles: leases, commands, and what the safety gates make of them.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/safety/mission.hpp"
#include "services/common/node.hpp"
#include "services/common/raw.hpp"
#include "services/ground_station/status.hpp"

namespace foretrack::station {

struct Outcome {
  bool ok = false;
  std::string reason;
  bool answered = true;  ///< by the safety gate, or here: false where the gate kept silent
};
using Report = std::function<void(const Outcome&)>;

/// Orders go out as MissionCommand; the gate decides and tells in SafetyState. A lease that an
/// operator takes here lasts a minute and is renewed by taking it again or by any command; while it
/// lasts, the station keeps the gate's short lease alive. An order that the gate has not answered
/// within a second is `unconfirmed`, sent once more, and a reason to join the bus anew; STOP is
/// sent ten times a second until the vehicle has stopped. Belongs to one thread; `now_s` is the
/// steady clock's.
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
  /// Needs the lease, but for stop, which goes on, for a minute, after it was reported unconfirmed.
  void command(const std::string& vehicle, MissionOrder order, const std::string& name,
               double now_s, Report report);

  std::map<std::string, MissionStatus> missions(double now_s) const;

 private:
  struct Lease {
    std::string name, id;
    double until_s = 0.0;
    double renewed_s = -1e9;
  };
  struct Pending {
    std::uint64_t id = 0;
    MissionOrder order = MissionOrder::kStart;
    std::string name, lease_id;
    double since_s = 0.0;
    double next_s = 0.0;   // when it is sent, or sent again
    bool retried = false;  // as no answer came
    std::vector<std::uint64_t> sent;
    Report report;  // none: it was told
  };
  struct Vehicle {
    std::unique_ptr<RawWriter> writer;
    std::unique_ptr<RawWriter> former;  // by the former node, while a STOP waits
    std::vector<Pending> pending;
    std::optional<Lease> lease;  // that was taken here
    MissionStatus mission;
    double lease_heard_s = 0.0;  // when mission was heard
    double stamp_s = 0.0;        // of the gate's clock, then
    bool stopped = false;
    std::optional<Unconfirmed> gave_up;  // until an order is answered
  };
  Vehicle* find(const std::string& vehicle, const Report& report);
  void order(Vehicle& vehicle, MissionOrder order, const std::string& name,
             const std::string& lease_id, double now_s, Report report);
  void send(Vehicle& vehicle, Pending& pending, double now_s);
  void settle(Vehicle& vehicle, std::uint64_t command_id, MissionResult result);
  void renew(Vehicle& vehicle, double now_s);
  void doubt(const std::string& name, Vehicle& vehicle, double now_s);
  void expire(Vehicle& vehicle, double now_s);
  void forget_former();
  static bool is_about_lease(MissionOrder order);
  static std::optional<Unconfirmed> unconfirmed(const Vehicle& vehicle, double now_s);
  std::uint64_t next_id();

  std::shared_ptr<Node> node_, former_node_;
  bool may_order_;
  std::function<void(const std::string&)> on_writer_;
  std::map<std::string, Vehicle> vehicles_;
  std::uint64_t last_id_ = 0;
};

}  // namespace foretrack::station
