// SPDX-License-Identifier: Apache-2.0
// A radio that loses, delays and reorders messages, and falls apart.
#pragma once

#include <string_view>

#include "core/common/random.hpp"
#include "core/simulator/fleet_scenario.hpp"

namespace foretrack {

/// Whether what one vehicle sends reaches another at that time, apart from losses.
bool hears(const LinkParams& link, std::string_view sender, std::string_view receiver,
           double now_s);

/// When a message that is sent now arrives; none: it is lost. Two random numbers each, whatever
/// becomes of it.
std::optional<double> arrival_s(const LinkParams& link, std::string_view sender,
                                std::string_view receiver, double now_s, Random& random);

/// Messages on their way to one receiver.
template <class Message>
class Inbox {
 public:
  void add(double arrives_s, const Message& message) { waiting_.push_back({arrives_s, message}); }

  /// Calls take(message) for each that has arrived, in the order of their arrival.
  template <class Take>
  void deliver(double now_s, const Take& take) {
    while (true) {
      std::size_t next = waiting_.size();
      for (std::size_t i = 0; i < waiting_.size(); ++i)
        if (waiting_[i].arrives_s <= now_s &&
            (next == waiting_.size() || waiting_[i].arrives_s < waiting_[next].arrives_s))
          next = i;
      if (next == waiting_.size()) return;
      take(waiting_[next].message);
      waiting_.erase(waiting_.begin() + static_cast<std::ptrdiff_t>(next));
    }
  }

 private:
  struct OnTheWay {
    double arrives_s;
    Message message;
  };
  std::vector<OnTheWay> waiting_;
};

}  // namespace foretrack
