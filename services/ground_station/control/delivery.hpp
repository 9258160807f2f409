// SPDX-License-Identifier: Apache-2.0
// How orders get to the safety gate of one vehicle: sent, answered, sent again, given up.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/safety/mission.hpp"
#include "services/common/raw.hpp"
#include "services/convert/order_proof.hpp"
#include "services/ground_station/status.hpp"

namespace foretrack::station {

struct Outcome {
  bool ok = false;
  std::string reason;
  bool answered = true;  ///< by the safety gate, or here: false where the gate kept silent
};
using Report = std::function<void(const Outcome&)>;

/// Leases come and go by themselves and are no news to an operator.
bool is_about_lease(MissionOrder order);

/// What the gate's last message said of itself.
struct HeardGate {
  double at_s = 0.0;     // when it came, by the steady clock
  double stamp_s = 0.0;  // of the gate's clock, then
  bool stopped = false;
};

/// Orders wait here until the gate has answered. One that is not answered within a second is
/// `unconfirmed` and sent once more; STOP is sent ten times a second until the vehicle has stopped.
/// Belongs to one thread; `now_s` is the steady clock's.
class Delivery {
 public:
  /// The secret of a lease; none: the order is given without one. It never leaves this process:
  /// orders are signed with it.
  using Key = std::shared_ptr<const LeaseKey>;

  /// Writes to the vehicle's mission/command.
  Delivery(std::string vehicle, std::unique_ptr<RawWriter> writer)
      : vehicle_(std::move(vehicle)), writer_(std::move(writer)) {}

  /// What is ordered and by whom; stamp, id and proof are set here.
  void order(const MissionCommand& what, Key key, double now_s, Report report);
  /// What the gate says of an order. One that it is still writing down was heard, and waits on.
  void settle(std::uint64_t command_id, MissionResult result);
  /// Sends what is due, gives up what has waited too long. on_unanswered: of an order that a gate
  /// which is heard does not answer.
  void tick(double now_s, const std::function<void(MissionOrder)>& on_unanswered);

  /// From now on writes by this one, and sends anew what waits; a STOP by the former one, too.
  void move_to(std::unique_ptr<RawWriter> writer);
  /// Lets the former writer go unless a STOP waits. True: it is still needed.
  bool needs_former();

  bool idle() const { return pending_.empty(); }
  /// The order that is not confirmed, or that was given up since the last answer.
  std::optional<Unconfirmed> unconfirmed(double now_s) const;

  HeardGate gate;  // to be kept up to date

 private:
  struct Pending {
    std::uint64_t id = 0;
    MissionCommand command;
    Key key;
    double since_s = 0.0;
    double next_s = 0.0;   // when it is sent, or sent again
    bool retried = false;  // as no answer came
    std::vector<std::uint64_t> sent;
    Report report;  // none: it was told
  };
  void send(Pending& pending, double now_s);
  double next_stamp_s(double now_s);
  void doubt(double now_s, const std::function<void(MissionOrder)>& on_unanswered);
  void expire(double now_s);
  bool stops() const;
  std::uint64_t next_id();

  std::string vehicle_;
  std::unique_ptr<RawWriter> writer_;
  std::unique_ptr<RawWriter> former_;  // while a STOP waits
  std::vector<Pending> pending_;
  std::optional<Unconfirmed> gave_up_;  // until an order is answered
  std::uint64_t last_id_ = 0;
  double sent_stamp_s_ = 0.0;  // of the last order, by a simulated clock
};

}  // namespace foretrack::station
