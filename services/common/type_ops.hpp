// SPDX-License-Identifier: Apache-2.0
// What the middleware needs to know of a message type, without a DDS header.
#pragma once

#include <cstddef>

#include "type_name.hpp"

namespace eprosima::fastcdr {
class Cdr;
}

namespace foretrack {

/// A generated type as a table of functions. Sizes and bytes are XCDR1 without the 4-byte header.
struct TypeOps {
  const char* name = nullptr;  // on the wire: pkg::msg::dds_::Name_
  bool keyed = false;
  std::size_t (*size)(const void*) = nullptr;
  void (*serialize)(const void*, eprosima::fastcdr::Cdr&) = nullptr;
  void (*deserialize)(void*, eprosima::fastcdr::Cdr&) = nullptr;
  void* (*create)() = nullptr;
  void (*destroy)(void*) = nullptr;
};

/// T's generated header must be included where this is used.
template <class T>
TypeOps type_ops() {
  TypeOps ops;
  ops.name = TypeName<T>::value;
  ops.keyed = T::isKeyDefined();
  ops.size = [](const void* p) { return T::getCdrSerializedSize(*static_cast<const T*>(p)); };
  ops.serialize = [](const void* p, eprosima::fastcdr::Cdr& cdr) {
    static_cast<const T*>(p)->serialize(cdr);
  };
  ops.deserialize = [](void* p, eprosima::fastcdr::Cdr& cdr) {
    static_cast<T*>(p)->deserialize(cdr);
  };
  ops.create = []() -> void* { return new T(); };
  ops.destroy = [](void* p) { delete static_cast<T*>(p); };
  return ops;
}

}  // namespace foretrack
