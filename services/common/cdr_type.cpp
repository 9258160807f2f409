// SPDX-License-Identifier: Apache-2.0
#include "services/common/cdr_type.hpp"

#include <fastcdr/Cdr.h>
#include <fastcdr/FastBuffer.h>

namespace foretrack {
namespace {

using eprosima::fastcdr::Cdr;
using eprosima::fastcdr::FastBuffer;
using eprosima::fastrtps::rtps::SerializedPayload_t;

constexpr std::uint32_t kHeaderBytes = 4;
// Payloads grow as needed; this is only what a history sets aside for each sample at first.
constexpr std::uint32_t kInitialPayloadBytes = 256;

thread_local std::uint64_t malformed = 0;

}  // namespace

std::uint64_t malformed_samples() {
  return malformed;
}

CdrType::CdrType(const TypeOps& ops) : ops_(ops) {
  setName(ops.name);
  m_typeSize = kInitialPayloadBytes;
  m_isGetKeyDefined = ops.keyed;
  auto_fill_type_object(false);
  auto_fill_type_information(false);
}

bool CdrType::serialize(void* data, SerializedPayload_t* payload) try {
  FastBuffer buffer(reinterpret_cast<char*>(payload->data), payload->max_size);
  Cdr cdr(buffer, Cdr::DEFAULT_ENDIAN, Cdr::DDS_CDR);
  payload->encapsulation = cdr.endianness() == Cdr::BIG_ENDIANNESS ? CDR_BE : CDR_LE;
  cdr.serialize_encapsulation();
  ops_.serialize(data, cdr);
  payload->length = static_cast<std::uint32_t>(cdr.getSerializedDataLength());
  return true;
} catch (const std::exception&) {
  return false;
}

// Everything is caught: the generated code throws on a bad header, on short data and on a length
// that memory cannot hold, and an exception here would end the process.
bool CdrType::deserialize(SerializedPayload_t* payload, void* data) try {
  FastBuffer buffer(reinterpret_cast<char*>(payload->data), payload->length);
  Cdr cdr(buffer, Cdr::DEFAULT_ENDIAN, Cdr::DDS_CDR);
  cdr.read_encapsulation();
  payload->encapsulation = cdr.endianness() == Cdr::BIG_ENDIANNESS ? CDR_BE : CDR_LE;
  ops_.deserialize(data, cdr);
  return true;
} catch (...) {
  ++malformed;
  return false;
}

std::function<uint32_t()> CdrType::getSerializedSizeProvider(void* data) {
  return [this, data] { return static_cast<std::uint32_t>(ops_.size(data)) + kHeaderBytes; };
}

}  // namespace foretrack
