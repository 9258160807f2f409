// SPDX-License-Identifier: Apache-2.0
// How an order proves that it comes from the lease's holder, although everybody reads the topic: a
// lease's id is a public key (Ed25519), and each order under it is signed with the private one,
// which never leaves its holder. The signature is over all of the order and the vehicle's name, so
// that no part of it can be changed and none be played to another vehicle. What is signed, as text:
//
//   foretrack order 3
//   LENGTH:VEHICLE
//   SEC NANOSEC            of the stamp
//   ID COMMAND
//   LENGTH:OPERATOR
//   LEASE
//    X Y X Y …             of the fence; each number as the 16 hexadecimal digits of its bits, each
//    MIN MAX               after a space; so are the altitudes
//   PERSON
//    DISTANCE HEIGHT BEARING CIRCLING X Y   of the framing and of the place to return to, as bits
//                           too, and no end of line after them
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

#include "foretrack_msgs/msg/MissionCommand.h"

namespace foretrack {

/// The secret of one lease. Cost of a signature: about 0.1 ms.
class LeaseKey {
 public:
  /// Throws std::runtime_error if there are no random numbers.
  LeaseKey();
  /// Of the lease: 64 hexadecimal digits.
  const std::string& id() const { return id_; }
  /// Sets the order's lease and its proof. Call it last.
  void sign(std::string_view vehicle, foretrack_msgs::msg::MissionCommand& order) const;

 private:
  std::array<unsigned char, 32> secret_{};
  std::string id_;
};

/// The order is signed with the key of the lease that it names. False without a lease. Cost: about
/// 0.2 ms, also for forgeries.
bool is_proved(std::string_view vehicle, const foretrack_msgs::msg::MissionCommand& order);

}  // namespace foretrack
