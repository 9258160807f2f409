// SPDX-License-Identifier: Apache-2.0
#include "services/common/raw_type.hpp"

#include <algorithm>

namespace foretrack {
namespace {

using eprosima::fastrtps::rtps::SerializedPayload_t;

constexpr std::uint32_t kHeaderBytes = 4;
constexpr std::uint32_t kInitialPayloadBytes = 256;  // histories grow from here
constexpr std::uint8_t kLittleEndian = 1;            // last bit of the header's second byte

}  // namespace

RawType::RawType(const std::string& name, bool keyed) {
  setName(name.c_str());
  m_typeSize = kInitialPayloadBytes;
  m_isGetKeyDefined = keyed;
  auto_fill_type_object(false);
  auto_fill_type_information(false);
}

bool RawType::serialize(void* data, SerializedPayload_t* payload) {
  const auto& bytes = *static_cast<const CdrBytes*>(data);
  if (bytes.size() < kHeaderBytes || bytes.size() > payload->max_size) return false;
  std::copy(bytes.begin(), bytes.end(), payload->data);
  payload->encapsulation = bytes[1] & kLittleEndian ? CDR_LE : CDR_BE;
  payload->length = static_cast<std::uint32_t>(bytes.size());
  return true;
}

bool RawType::deserialize(SerializedPayload_t* payload, void* data) try {
  if (payload->length < kHeaderBytes) return false;
  auto& bytes = *static_cast<CdrBytes*>(data);
  bytes.assign(payload->data, payload->data + payload->length);
  return true;
} catch (...) {  // no memory: the sample is lost, not the process
  return false;
}

std::function<uint32_t()> RawType::getSerializedSizeProvider(void* data) {
  return [data] { return static_cast<std::uint32_t>(static_cast<const CdrBytes*>(data)->size()); };
}

bool RawType::getKey(void*, eprosima::fastrtps::rtps::InstanceHandle_t* handle, bool) {
  *handle = eprosima::fastrtps::rtps::InstanceHandle_t();
  return true;
}

}  // namespace foretrack
