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
};
using Report = std::function<void(const Outcome&)>;

/// Orders go out as MissionCommand; the gate decides and tells in SafetyState. A lease that an
/// operator takes here lasts a minute and is renewed by taking it again or by any command; while it
/// lasts, the station keeps the gate's short lease alive. Belongs to one thread; `now_s` is the
/// steady clock's.
class Commander {
 public:
  /// `may_order`: else it only listens. `on_writer` is told the name on the wire of each topic that
  /// it begins to write.
  Commander(std::shared_ptr<Node> node, bool may_order,
            std::function<void(const std::string&)> on_writer);
  ~Commander();

  /// From now on writes by this node. Leases, and orders that wait for an answer, go on.
  void move_to(std::shared_ptr<Node> node);

  /// A sample of a vehicle's safety/state.
  void hear(const std::string& vehicle, const CdrBytes& safety_state, double now_s);
  /// Sends what is due, answers what has waited too long. Call it every 20 ms.
  void tick(double now_s);

  void take(const std::string& vehicle, const std::string& name, double now_s, Report report);
  void release(const std::string& vehicle, const std::string& name, double now_s, Report report);
  /// From its holder to another operator, without a moment in which a third one could take it.
  void hand_over(const std::string& vehicle, const std::string& name, const std::string& to,
                 double now_s, Report report);
  /// Needs the lease, but for stop, which is repeated until the gate says that it stopped.
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
    double deadline_s = 0.0;
    double next_s = 0.0;  // when it is sent, or sent again
    std::vector<std::uint64_t> sent;
    Report report;
  };
  struct Vehicle {
    std::unique_ptr<RawWriter> writer;
    std::vector<Pending> pending;
    std::optional<Lease> lease;  // that was taken here
    MissionStatus mission;
    double lease_heard_s = 0.0;  // when mission was heard
    double stamp_s = 0.0;        // of the gate's clock, then
    bool stopped = false;
  };
  Vehicle* find(const std::string& vehicle, const Report& report);
  void order(Vehicle& vehicle, MissionOrder order, const std::string& name,
             const std::string& lease_id, double now_s, Report report);
  void send(Vehicle& vehicle, Pending& pending, double now_s);
  void settle(Vehicle& vehicle, std::uint64_t command_id, MissionResult result);
  void renew(Vehicle& vehicle, double now_s);
  std::uint64_t next_id();

  std::shared_ptr<Node> node_;
  bool may_order_;
  std::function<void(const std::string&)> on_writer_;
  std::map<std::string, Vehicle> vehicles_;
  std::uint64_t last_id_ = 0;
};

}  // namespace foretrack::station
