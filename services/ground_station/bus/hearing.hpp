// SPDX-License-Identifier: Apache-2.0
// Who is heard, and who lives without being heard.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "services/common/peer.hpp"

namespace foretrack::station {

/// Two participants may lose each other on one side only, by a pause or a gap of the link that just
/// lasted a lease. Fast DDS 2.9 then does not exchange their endpoints again: one hears nothing of
/// the other from then on. Here that is told from an end. Who ended, is frozen or out of reach is
/// dropped by discovery after its lease, and does not come back.
class Hearing {
 public:
  void heard(const PeerId& from, double now_s);
  /// Names a peer that was heard each second or two for 5 s, and of which nothing came since,
  /// though it lives: its lease is over and discovery has not dropped it, or it was discovered
  /// again 5 s ago. Empty: there is none. `peers` are those that discovery holds for alive.
  std::string complaint(const std::vector<Peer>& peers, double now_s);
  /// When less is read than before, or all is new: a silence from here on tells nothing.
  void reset() { voices_.clear(); }

 private:
  struct Voice {
    double steady_since_s = 0.0;  // without a longer gap
    double last_s = 0.0;
  };
  std::map<PeerId, Voice> voices_;
};

}  // namespace foretrack::station
