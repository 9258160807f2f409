// SPDX-License-Identifier: Apache-2.0
// Any bytes into what reads the network: messages of WebSocket clients, ranges, tokens, recordings.
// With clang: -DFORETRACK_FUZZ=ON builds it for libFuzzer. Else the test feeds it seeded changes of
// valid messages.
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "services/ground_station/foxglove/protocol.hpp"
#include "services/ground_station/http/guard.hpp"
#include "services/ground_station/hub/hub.hpp"
#include "services/ground_station/mcap/format.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace foretrack::station;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  foxglove::parse_text(text);
  foxglove::parse_binary({data, size});
  foxglove::choose_subprotocol(text);
  Request request;
  request.query = text;
  token_of(request);
  mcap::Decoder decoder({data, size});
  decoder.strings();
  decoder.string();
  decoder.rest();
  Hub hub("fuzz", "0", {});
  Channel channel;
  channel.id = 1;
  hub.open(channel);
  const auto client = hub.join("fuzz", {[] {}, [](const std::string&) {}}, 0.0);
  client->on_text(text, 0.0);
  hub.deliver({{1, 0, std::make_shared<const Bytes>(16)}}, 0.0);
  while (client->next(0.0)) {
  }
  return 0;
}
