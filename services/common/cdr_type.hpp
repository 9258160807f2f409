// SPDX-License-Identifier: Apache-2.0
// One type support for every message; a malformed sample is a rejected one, never an exception.
#pragma once

#include <cstdint>
#include <fastdds/dds/topic/TopicDataType.hpp>

#include "services/common/type_ops.hpp"

namespace foretrack {

class CdrType : public eprosima::fastdds::dds::TopicDataType {
 public:
  explicit CdrType(const TypeOps& ops);

  bool serialize(void* data, eprosima::fastrtps::rtps::SerializedPayload_t* payload) override;
  bool deserialize(eprosima::fastrtps::rtps::SerializedPayload_t* payload, void* data) override;
  std::function<uint32_t()> getSerializedSizeProvider(void* data) override;
  void* createData() override { return ops_.create(); }
  void deleteData(void* data) override { ops_.destroy(data); }
  bool getKey(void*, eprosima::fastrtps::rtps::InstanceHandle_t*, bool) override { return false; }

 private:
  TypeOps ops_;
};

/// Samples that this thread failed to deserialise, ever. Readers compare it before and after a
/// take.
std::uint64_t malformed_samples();

}  // namespace foretrack
