// SPDX-License-Identifier: Apache-2.0
// Frames and the transforms between them, as /tf and /tf_static tell of them (REP-105).
#pragma once

#include <deque>
#include <map>
#include <optional>
#include <string>

#include "core/common/geometry.hpp"

namespace foretrack {

/// Each frame has one parent. Those that move keep a history. Memory is bounded: what would be too
/// much is not taken.
class TransformTree {
 public:
  enum class Added {
    kTaken,
    kContradicts,  ///< the frame has another parent, or sits elsewhere on it: the first one stays
    kFull
  };
  /// T_parent_child of a frame that does not move against its parent.
  Added add_static(const std::string& parent, const std::string& child, const Pose& T_parent_child);
  /// The same of one that does (a gimbal's joint), at a time. Stamps that go back by more than a
  /// second mean that its source was started anew.
  Added add_moving(const std::string& parent, const std::string& child, double stamp_s,
                   const Pose& T_parent_child);

  enum class Status {
    kFound,
    kNoChain,  ///< no transforms lead from one frame to the other
    kNotThen   ///< they do, but one of them is not known at that time
  };
  struct Found {
    Status status = Status::kNoChain;
    Pose T_to_from = Pose::Identity();  ///< only if found
    std::string why;                    ///< not found, in words
    bool moves = false;                 ///< a frame on the way has a history
  };
  /// The pose of frame `from` in frame `to` at a time. Between the stamps of a frame that moves it
  /// is interpolated; the newest one holds for 0.1 s. Cost: linear in the frames on the way.
  Found find(const std::string& to, const std::string& from, double stamp_s) const;

 private:
  struct Stamped {
    double stamp_s = 0.0;
    Pose T_parent_child = Pose::Identity();
  };
  struct Frame {
    std::string parent;
    bool moves = false;
    std::deque<Stamped> history;  // one of a frame that does not move
  };
  struct Link {
    std::string frame;
    Pose T_frame_from = Pose::Identity();
  };
  std::optional<Added> refused(const std::string& parent, const std::string& child,
                               bool moves) const;
  bool climb(const std::string& from, const std::string& until, double stamp_s,
             std::deque<Link>& chain, Found& found) const;

  std::map<std::string, Frame> frames_;  // by child
};

}  // namespace foretrack
