// SPDX-License-Identifier: Apache-2.0
// A flight that was rendered beforehand, and is put on the bus again at its own pace.
#pragma once

#include <atomic>
#include <vector>

#include "core/simulator/simulate.hpp"
#include "services/simulator/world_writer.hpp"

namespace foretrack {

/// 10 ms of it.
struct RecordedStep {
  SimulatorOutput out;  // its images are those here
  std::optional<ColorImage> color;
  std::optional<DepthImage> depth;
};

/// The scenario flown in lock-step by who knows where the person is, so that the camera moves as in
/// a flight. 30 images a second are 28 MB a second of memory.
std::vector<RecordedStep> record_world(const Scenario& scenario);

/// Publishes a recorded flight as sensors of now: stamps are the computer's time. What is due is
/// published late rather than not at all.
class Replay {
 public:
  /// `steps` outlives it; stamps are written into them.
  Replay(Service& service, const Scenario& scenario, std::vector<RecordedStep>& steps);

  /// From any thread: the first step is due at this time (Unix).
  void start_at(double begin_s) { begin_s_ = begin_s; }
  bool is_over() const { return over_; }

 private:
  void publish_due();

  Clock& clock_;
  std::vector<RecordedStep>& steps_;
  WorldWriter writer_;
  std::size_t next_ = 0;
  std::atomic<double> begin_s_ = 1e18;
  std::atomic<bool> over_ = false;
};

}  // namespace foretrack
