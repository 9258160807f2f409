// SPDX-License-Identifier: Apache-2.0
// The same picture for a link that cannot carry it as it is.
#pragma once

#include <memory>
#include <optional>

#include "services/ground_station/bus/channel.hpp"

namespace foretrack::station {

/// Pictures that stand alone, the vehicle's JPEG; a video has none lighter.
bool can_be_lighter(const Channel& channel);

/// A quarter of the pixels and less detail: some 4 kB, a few packets. null: it is no picture, or no
/// smaller so. Cost: 4 ms for 640 × 480 pixels.
std::shared_ptr<const Bytes> lighten(const Bytes& cdr);

/// One sample for clients on good and bad links; it is made lighter once, and only if one asks.
class PerLink {
 public:
  PerLink(const Channel& channel, const Sample& sample)
      : full_(sample), can_be_lighter_(station::can_be_lighter(channel)) {}

  const Sample& full() const { return full_; }
  bool can_be_lighter() const { return can_be_lighter_; }
  const Sample& light();

 private:
  const Sample& full_;
  bool can_be_lighter_;
  std::optional<Sample> light_;
};

}  // namespace foretrack::station
