// SPDX-License-Identifier: Apache-2.0
#include "services/ground_station/recording/record_bus.hpp"

#include <chrono>
#include <stdexcept>
#include <thread>

#include "services/ground_station/bus/bus.hpp"

namespace foretrack::station {

void record_bus(std::shared_ptr<Node> node, Recorder& recorder, Stop& stop,
                const std::function<void()>& look) {
  if (const auto fault = recorder.start(); !fault.empty()) throw std::runtime_error(fault);
  std::unique_ptr<Bus> bus;
  bus = std::make_unique<Bus>(
      std::move(node),
      Outlet{[&](const Channel& channel) {
               recorder.open(channel);
               bus->want(recorder.wanted());
             },
             [](std::uint32_t) {}, [&](const auto& samples) { recorder.samples(samples); }});
  std::thread looker([&] {
    while (!stop.requested()) {
      look();
      std::this_thread::sleep_for(std::chrono::milliseconds(100));
    }
  });
  bus->run(stop);
  looker.join();
  recorder.stop();
}

}  // namespace foretrack::station
