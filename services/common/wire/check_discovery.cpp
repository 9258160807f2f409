// SPDX-License-Identifier: Apache-2.0
#include "services/common/wire/check_discovery.hpp"

namespace foretrack::wire {
namespace {

constexpr std::size_t kEncapsulation = 4;  // two bytes of kind, two of options
constexpr std::size_t kGuid = 16;

// Parameter ids; RTPS 2.5 table 9.14, DDS-Security 7.4.1, XTypes 7.6.2, Fast DDS' own above 0x8000.
enum : std::uint16_t {
  kSentinel = 0x0001,
  kTopicName = 0x0005,
  kTypeName = 0x0007,
  kPartition = 0x0029,
  kUserData = 0x002c,
  kGroupData = 0x002d,
  kTopicData = 0x002e,
  kContentFilter = 0x0035,
  kPropertyList = 0x0059,
  kEntityName = 0x0062,
  kTypeId = 0x0069,
  kTypeObject = 0x0072,
  kDataRepresentation = 0x0073,
  kTypeInformation = 0x0075,
  kIdentityToken = 0x1001,
  kPermissionsToken = 0x1002,
  kIdentityStatusToken = 0x1006,
  kDataSharing = 0x8006,
};

// The library reads it as text that ends with a zero, wherever that is.
bool string_fits(Reader& reader) {
  const std::uint32_t length = reader.u32();
  const auto text = reader.take(length);
  const bool ends = length == 0 || (text.size() == length && text.back() == 0);
  reader.align();
  return reader.ok() && ends;
}

bool strings_fit(Reader& reader, std::uint32_t each) {
  const std::uint32_t count = reader.u32();
  for (std::uint32_t i = 0; i < count; ++i)
    for (std::uint32_t k = 0; k < each; ++k)
      if (!string_fits(reader)) return false;
  return reader.ok();
}

bool octets_fit(Reader& reader) {
  const std::uint32_t length = reader.u32();
  reader.skip(length);
  reader.align();
  return reader.ok();
}

bool binary_properties_fit(Reader& reader) {
  const std::uint32_t count = reader.u32();
  for (std::uint32_t i = 0; i < count; ++i)
    if (!string_fits(reader) || !octets_fit(reader)) return false;
  return reader.ok();
}

// Of DDS-Security: a class, properties, binary properties.
bool data_holder_fits(Reader& reader) {
  return string_fits(reader) && strings_fit(reader, 2) && binary_properties_fit(reader);
}

// A count, and so many numbers of a size.
bool numbers_fit(Reader& reader, std::size_t size) {
  const std::uint32_t count = reader.u32();
  return reader.ok() && count <= reader.left() / size;
}

bool is_blanked(std::uint16_t id) {
  return id == kTypeId || id == kTypeObject || id == kTypeInformation || id == kContentFilter;
}

// Others have one length each, which the library compares.
bool parameter_fits(std::uint16_t id, Reader value) {
  switch (id) {
    case kTopicName:
    case kTypeName:
    case kEntityName:
      return string_fits(value);
    case kPartition:
      return strings_fit(value, 1);
    case kPropertyList:
      return strings_fit(value, 2);
    case kUserData:
    case kGroupData:
    case kTopicData:
      return octets_fit(value);
    case kDataRepresentation:
      return numbers_fit(value, 2);
    case kDataSharing:
      return numbers_fit(value, 8);
    case kIdentityToken:
    case kPermissionsToken:
    case kIdentityStatusToken:
      return data_holder_fits(value);
    default:
      return true;
  }
}

bool sign_of_life_fits(Reader reader) {
  constexpr std::size_t kPrefixAndKind = 16;
  reader.skip(kPrefixAndKind);
  return reader.ok() && octets_fit(reader);
}

bool handshake_fits(Reader reader) {
  constexpr std::size_t kIdentity = kGuid + 8;
  reader.skip(2 * kIdentity + 3 * kGuid);
  if (!string_fits(reader)) return false;
  const std::uint32_t count = reader.u32();
  for (std::uint32_t i = 0; i < count; ++i)
    if (!data_holder_fits(reader)) return false;
  return reader.ok();
}

}  // namespace

Form form_of(std::uint32_t entity_id) {
  switch (entity_id) {
    case kParticipantWriter:
    case 0x000100c7:
    case 0xff0101c2:
    case 0xff0101c7:
    case 0x000002c2:  // topics
    case 0x000002c7:
    case 0x000003c2:  // writers
    case 0x000003c7:
    case 0xff0003c2:
    case 0xff0003c7:
    case 0x000004c2:  // readers
    case 0x000004c7:
    case 0xff0004c2:
    case 0xff0004c7:
      return Form::kParameters;
    case 0x000200c2:
    case 0x000200c7:
    case 0xff0200c2:
    case 0xff0200c7:
      return Form::kSignOfLife;
    case 0x000201c3:
    case 0x000201c4:
    case 0xff0202c3:
    case 0xff0202c4:
      return Form::kHandshake;
    default:
      return Form::kFree;
  }
}

bool check_parameters(Reader& reader, Blanks& blanks) {
  while (true) {
    const std::size_t position = reader.position();
    const std::uint16_t id = reader.u16(), length = reader.u16();
    if (!reader.ok()) return false;
    if (id == kSentinel) return true;
    const auto value = reader.take(length);
    reader.align();
    if (!reader.ok()) return false;
    if (is_blanked(id))
      blanks.add(position);
    else if (!parameter_fits(id, Reader(value, reader.little_endian())))
      return false;
  }
}

bool has_identity(std::span<const std::uint8_t> payload) {
  Reader reader(payload, payload.size() > 1 && payload[1] % 2 == 1);
  reader.skip(kEncapsulation);
  while (true) {
    const std::uint16_t id = reader.u16(), length = reader.u16();
    if (!reader.ok() || id == kSentinel) return false;
    if (id == kIdentityToken) return true;
    reader.skip(length);
    reader.align();
  }
}

bool check_payload(Form form, std::span<const std::uint8_t> payload, Blanks& blanks) {
  if (form == Form::kFree) return true;
  if (payload.size() < kEncapsulation || payload[0] != 0) return false;
  const std::uint8_t kind = payload[1];  // CDR, or a list of parameters; odd: little-endian
  if ((form == Form::kParameters) != (kind == 2 || kind == 3) || kind > 3) return false;
  Reader reader(payload, kind % 2 == 1);
  reader.skip(kEncapsulation);
  if (form == Form::kParameters) return check_parameters(reader, blanks);
  return form == Form::kSignOfLife ? sign_of_life_fits(reader) : handshake_fits(reader);
}

}  // namespace foretrack::wire
