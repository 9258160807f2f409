// SPDX-License-Identifier: Apache-2.0
// A message of PX4's in another release's layout than the IDL has.
#pragma once

#include "services/common/cdr_type.hpp"
#include "services/common/px4_releases.hpp"

namespace foretrack {

/// On the wire as the release has it; here as the IDL.
class Px4Type : public CdrType {
 public:
  Px4Type(const TypeOps& ops, std::string_view release);
  /// Whether the release has the message in another layout.
  static bool is_needed(const TypeOps& ops, std::string_view release);

  bool serialize(void* data, eprosima::fastrtps::rtps::SerializedPayload_t* payload) override;
  bool deserialize(eprosima::fastrtps::rtps::SerializedPayload_t* payload, void* data) override;
  std::function<uint32_t()> getSerializedSizeProvider(void* data) override;

 private:
  Px4Layout wire_, ours_;
};

}  // namespace foretrack
