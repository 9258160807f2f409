// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "core/common/random.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace foretrack::station {
namespace {

TEST(Fuzz, NoChangeOfAValidMessageBreaksTheParsers) {
  const std::vector<std::string> seeds = {
      R"({"op": "subscribe", "subscriptions": [{"id": 0, "channelId": 1}]})",
      R"({"op": "unsubscribe", "subscriptionIds": [0]})", "foxglove.sdk.v1, foxglove.websocket.v1",
      "a=b&token=0123&c", std::string("\x08\0\0\0\x01\0\0\0a\0\0\0\0", 13)};
  Random random(7);
  for (int round = 0; round < 20'000; ++round) {
    std::string text = seeds[static_cast<std::size_t>(round) % seeds.size()];
    for (int change = 0; change < 1 + round % 4; ++change) {
      const auto at = static_cast<std::size_t>(random.uniform() * static_cast<double>(text.size()));
      const auto byte = static_cast<char>(256.0 * random.uniform());
      if (round % 3 == 0) text.insert(at, 1, byte);
      if (round % 3 == 1) text[at] = byte;
      if (round % 3 == 2 && text.size() > 1) text.erase(at, 1);
    }
    LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(text.data()), text.size());
  }
}

}  // namespace
}  // namespace foretrack::station
