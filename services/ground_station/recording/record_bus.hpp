// SPDX-License-Identifier: Apache-2.0
// A recorder that hears the bus.
#pragma once

#include <functional>
#include <memory>

#include "services/common/node.hpp"
#include "services/common/stop.hpp"
#include "services/ground_station/recording/recorder.hpp"

namespace foretrack::station {

/// Gives the recorder what it wants until the stop. Ten times a second `look` is called, in a
/// thread of its own. Throws std::runtime_error if it cannot start to record.
void record_bus(std::shared_ptr<Node> node, Recorder& recorder, Stop& stop,
                const std::function<void()>& look);

}  // namespace foretrack::station
