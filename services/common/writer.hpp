// SPDX-License-Identifier: Apache-2.0
// A typed writer of one topic.
#pragma once

#include "services/common/endpoint.hpp"
#include "services/common/node.hpp"

namespace foretrack {

/// Include the message's generated header where this is used.
template <class Topic>
class Writer {
 public:
  using Type = typename Topic::Type;

  explicit Writer(Node& node) : core_(&node.add_writer(Topic::info, type_ops<Type>())) {}

  /// A sample to fill and write again and again, so that its buffers are reused.
  Type& sample() { return sample_; }
  bool write() { return core_->write(&sample_); }
  bool write(const Type& sample) { return core_->write(&sample); }

  int readers() const { return core_->stats.peers; }
  const EndpointStats& stats() const { return core_->stats; }

 private:
  WriterCore* core_;
  Type sample_;
};

}  // namespace foretrack
