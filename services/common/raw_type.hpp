// SPDX-License-Identifier: Apache-2.0
// A type support for any type: its samples are their CDR bytes.
#pragma once

#include <fastdds/dds/topic/TopicDataType.hpp>
#include <string>

#include "services/common/raw.hpp"

namespace foretrack {

class RawType : public eprosima::fastdds::dds::TopicDataType {
 public:
  RawType(const std::string& name, bool keyed);

  bool serialize(void* data, eprosima::fastrtps::rtps::SerializedPayload_t* payload) override;
  bool deserialize(eprosima::fastrtps::rtps::SerializedPayload_t* payload, void* data) override;
  std::function<uint32_t()> getSerializedSizeProvider(void* data) override;
  void* createData() override { return new CdrBytes(); }
  void deleteData(void* data) override { delete static_cast<CdrBytes*>(data); }
  /// All samples are one instance: what the key is, only the type's owner knows.
  bool getKey(void*, eprosima::fastrtps::rtps::InstanceHandle_t* handle, bool) override;
};

}  // namespace foretrack
