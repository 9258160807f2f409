// SPDX-License-Identifier: Apache-2.0
#include "core/common/transform_tree.hpp"

#include <algorithm>

namespace foretrack {
namespace {

constexpr std::size_t kMostFrames = 512;
constexpr std::size_t kMostStamps = 400;  // of one frame: 2 s at 200 Hz
constexpr std::size_t kMostLinks = 32;    // transforms that lead in a circle end here
constexpr double kHold_s = 0.1;
constexpr double kRestart_s = 1.0;
constexpr double kSamePlace_m = 1e-3, kSameAngle_rad = 2e-3;

bool same(const Pose& a, const Pose& b) {
  return (a.translation() - b.translation()).norm() < kSamePlace_m &&
         Quat(a.rotation()).angularDistance(Quat(b.rotation())) < kSameAngle_rad;
}

Pose between(const Pose& a, const Pose& b, double share) {
  Pose pose = Pose::Identity();
  pose.linear() = Quat(a.rotation()).slerp(share, Quat(b.rotation())).toRotationMatrix();
  pose.translation() = (1.0 - share) * a.translation() + share * b.translation();
  return pose;
}

std::string quoted(const std::string& name) {
  std::string text = "'";
  text.append(name, 0, 64);
  return text += "'";
}

std::string seconds_text(double duration_s) {
  std::string text = std::to_string(duration_s);
  text.resize(text.find('.') + 3);
  return text += " s";
}

}  // namespace

std::optional<TransformTree::Added> TransformTree::refused(const std::string& parent,
                                                           const std::string& child,
                                                           bool moves) const {
  const auto it = frames_.find(child);
  if (it == frames_.end())
    return frames_.size() < kMostFrames ? std::nullopt : std::optional(Added::kFull);
  if (it->second.parent != parent || it->second.moves != moves) return Added::kContradicts;
  return std::nullopt;
}

TransformTree::Added TransformTree::add_static(const std::string& parent, const std::string& child,
                                               const Pose& T_parent_child) {
  if (const auto why = refused(parent, child, false)) return *why;
  Frame& frame = frames_[child];
  frame.parent = parent;
  if (frame.history.empty()) frame.history.push_back({0.0, T_parent_child});
  return same(frame.history.front().T_parent_child, T_parent_child) ? Added::kTaken
                                                                    : Added::kContradicts;
}

TransformTree::Added TransformTree::add_moving(const std::string& parent, const std::string& child,
                                               double stamp_s, const Pose& T_parent_child) {
  if (const auto why = refused(parent, child, true)) return *why;
  Frame& frame = frames_[child];
  frame.parent = parent;
  frame.moves = true;
  auto& history = frame.history;
  if (!history.empty() && stamp_s < history.back().stamp_s - kRestart_s) history.clear();
  if (!history.empty() && stamp_s <= history.back().stamp_s) return Added::kTaken;
  if (history.size() == kMostStamps) history.pop_front();
  history.push_back({stamp_s, T_parent_child});
  return Added::kTaken;
}

// Up to `until` or the root, with the pose of `from` in each frame on the way.
bool TransformTree::climb(const std::string& from, const std::string& until, double stamp_s,
                          std::deque<Link>& chain, Found& found) const {
  chain.push_back({from});
  while (chain.back().frame != until && chain.size() < kMostLinks) {
    const auto it = frames_.find(chain.back().frame);
    if (it == frames_.end()) return true;
    const auto& history = it->second.history;
    found.moves |= it->second.moves;
    Pose T = history.back().T_parent_child;
    if (it->second.moves && stamp_s < history.back().stamp_s) {
      const auto next =
          std::lower_bound(history.begin(), history.end(), stamp_s,
                           [](const Stamped& s, double at_s) { return s.stamp_s < at_s; });
      if (next == history.begin() && next->stamp_s > stamp_s) {
        found.status = Status::kNotThen;
        found.why = "the transform of " + quoted(it->first) + " begins " +
                    seconds_text(next->stamp_s - stamp_s) + " later";
        return false;
      }
      const auto& before = next == history.begin() ? *next : *std::prev(next);
      const double gap_s = next->stamp_s - before.stamp_s;
      T = between(before.T_parent_child, next->T_parent_child,
                  gap_s > 0.0 ? (stamp_s - before.stamp_s) / gap_s : 0.0);
    } else if (it->second.moves && stamp_s > history.back().stamp_s + kHold_s) {
      found.status = Status::kNotThen;
      found.why = "the newest transform of " + quoted(it->first) + " is " +
                  seconds_text(stamp_s - history.back().stamp_s) + " older";
      return false;
    }
    chain.push_back({it->second.parent, T * chain.back().T_frame_from});
  }
  return true;
}

TransformTree::Found TransformTree::find(const std::string& to, const std::string& from,
                                         double stamp_s) const {
  Found found;
  std::deque<Link> up, down;
  if (!climb(from, to, stamp_s, up, found)) return found;
  if (up.back().frame != to && !climb(to, from, stamp_s, down, found)) return found;
  for (const Link& link : up) {
    if (link.frame != to && std::none_of(down.begin(), down.end(),
                                         [&](const Link& l) { return l.frame == link.frame; }))
      continue;
    found.status = Status::kFound;
    found.T_to_from = link.T_frame_from;
    for (const Link& other : down)
      if (other.frame == link.frame && link.frame != to)
        found.T_to_from = other.T_frame_from.inverse() * link.T_frame_from;
    return found;
  }
  found.why = up.size() == 1 ? "no transform of " + quoted(from) + " is known"
                             : "transforms lead from " + quoted(from) + " to " +
                                   quoted(up.back().frame) + ", and not to " + quoted(to);
  return found;
}

}  // namespace foretrack
