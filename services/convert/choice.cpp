// SPDX-License-Identifier: Apache-2.0
#include "services/convert/choice.hpp"

#include "services/convert/geometry.hpp"

namespace foretrack {
namespace {

namespace states = foretrack_msgs::msg::TargetChoice_Constants;
static_assert(states::STATE_WAITING == int(ChoiceStatus::kWaiting));
static_assert(states::STATE_FOLLOWING == int(ChoiceStatus::kFollowing));
static_assert(states::STATE_DOUBTFUL == int(ChoiceStatus::kDoubtful));
static_assert(states::STATE_SEARCHING == int(ChoiceStatus::kSearching));
static_assert(states::STATE_LOST == int(ChoiceStatus::kLost));

constexpr std::size_t kMostBytes = 16384;  // of a picture, as the IDL bounds it

std::vector<std::uint8_t> bounded(const std::vector<std::uint8_t>& picture) {
  return picture.size() <= kMostBytes ? picture : std::vector<std::uint8_t>();
}

}  // namespace

void to_idl(const ChoiceReport& in, foretrack_msgs::msg::TargetChoice& out) {
  const ChoiceResult& choice = in.choice;
  set_header(out.header(), in.stamp_s);
  out.state(static_cast<std::uint8_t>(choice.status));
  out.person_id(choice.person_id);
  out.likeness(choice.likeness);
  out.waits_s(choice.waits_s);
  out.picture(bounded(in.picture));
  out.candidates().resize(static_cast<std::size_t>(choice.count));
  for (int i = 0; i < choice.count; ++i) {
    auto& candidate = out.candidates()[i];
    candidate.person_id(choice.candidates[i].person_id);
    candidate.likeness(choice.candidates[i].likeness);
    candidate.position_m(to_array(choice.candidates[i].torso_enu_m));
    candidate.picture(bounded(in.pictures[i]));
  }
}

Converted<ChoiceReport> from_idl(const foretrack_msgs::msg::TargetChoice& in) {
  Checks checks;
  ChoiceReport out;
  check_header(checks, in.header());
  checks.enumerator("choice.state", in.state(), states::STATE_LOST);
  checks.in_range("choice.likeness", in.likeness(), 0.0, 1.0);
  checks.in_range("choice.waits_s", in.waits_s(), 0.0, limits::kDuration_s);
  checks.count("choice.picture", in.picture().size(), 0, kMostBytes);
  checks.count("choice.candidates", in.candidates().size(), 0, ChoiceResult::kMostCandidates);
  for (const auto& candidate : in.candidates()) {
    checks.in_range("choice.candidates.likeness", candidate.likeness(), 0.0, 1.0);
    checks.within("choice.candidates.position_m", candidate.position_m(), limits::kPosition_m);
    checks.count("choice.candidates.picture", candidate.picture().size(), 0, kMostBytes);
  }
  if (!checks.ok()) return checks.result(out);
  ChoiceResult& choice = out.choice;
  out.stamp_s = seconds(in.header().stamp());
  choice.status = static_cast<ChoiceStatus>(in.state());
  choice.person_id = in.person_id();
  choice.likeness = in.likeness();
  choice.waits_s = in.waits_s();
  for (const auto& candidate : in.candidates())
    choice.candidates[choice.count++] = {candidate.person_id(), candidate.likeness(),
                                         to_vec3(candidate.position_m()), 0.0};
  return checks.result(std::move(out));
}

}  // namespace foretrack
