// SPDX-License-Identifier: Apache-2.0
#include "services/operator/words.hpp"

#include <array>
#include <cstddef>

namespace foretrack {
namespace {

template <std::size_t N>
std::string_view word(const std::array<std::string_view, N>& words, std::uint8_t index) {
  return index < N ? words[index] : "unknown";
}

}  // namespace

std::string_view track_word(std::uint8_t status) {
  static constexpr std::array<std::string_view, 4> kWords = {"never seen", "tracking", "coasting",
                                                             "lost"};
  return word(kWords, status);
}

std::string_view prediction_word(std::uint8_t status) {
  static constexpr std::array<std::string_view, 4> kWords = {"ok", "no target", "target blocked",
                                                             "search exhausted"};
  return word(kWords, status);
}

std::string_view plan_word(std::uint8_t status) {
  static constexpr std::array<std::string_view, 5> kWords = {"none", "fresh", "kept", "search",
                                                             "hold"};
  return word(kWords, status);
}

std::string_view mode_word(std::uint8_t mode) {
  static constexpr std::array<std::string_view, 5> kWords = {"track", "coast", "hover", "brake",
                                                             "silent"};
  return word(kWords, mode);
}

std::string_view service_word(std::uint8_t state) {
  static constexpr std::array<std::string_view, 3> kWords = {"running", "degraded", "stopping"};
  return word(kWords, state);
}

std::string_view explain_plan(std::uint8_t reason) {
  static constexpr std::array<std::string_view, 11> kSentences = {
      "all is well",
      "no person has been seen yet",
      "the person was lost",
      "an input is too old",
      "the free space along the way is too tight",
      "the optimiser did not converge",
      "the trajectory broke the vehicle's limits",
      "the trajectory came too near an obstacle",
      "the trajectory did not continue the one that is flown",
      "the trajectory's stop would not be safe",
      "the trajectory came too near the person"};
  return word(kSentences, reason);
}

std::string_view explain_gate(std::uint8_t reason) {
  static constexpr std::array<std::string_view, 20> kSentences = {
      "all is well",
      "no plan has come yet",
      "plans have ceased to come",
      "the last plan has come to its end",
      "the planner itself asks to stand still",
      "the vehicle is far from where it was told to be",
      "the vehicle's state has ceased to come",
      "nothing is heard from the autopilot",
      "the autopilot is not in offboard mode",
      "an operator's order",
      "the odometry jumps",
      "the odometry is frozen",
      "the odometry disagrees with its own velocity",
      "an obstacle is in the way",
      "somebody is in the way",
      "the vehicle is outside of its fence",
      "the vehicle is outside of its altitudes",
      "the battery is at its reserve",
      "nothing is heard from the operator",
      "the images are frozen, dark or covered"};
  return word(kSentences, reason);
}

}  // namespace foretrack
