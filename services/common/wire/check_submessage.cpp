// SPDX-License-Identifier: Apache-2.0
#include "services/common/wire/check_submessage.hpp"

#include <algorithm>

#include "services/common/wire/check_discovery.hpp"

namespace foretrack::wire {
namespace {

constexpr std::int64_t kHighestNumber = std::int64_t{1} << 62;  // so that nobody's + 1 overflows
constexpr int kInlineFlag = 1, kDataFlag = 2, kKeyFlag = 3, kFragmentKeyFlag = 2;
constexpr int kNoTimeFlag = 1;

class MessageBlanks : public Blanks {
 public:
  MessageBlanks(Checked& checked, std::size_t base) : checked_(checked), base_(base) {}
  void add(std::size_t position) override {
    if (checked_.blank_count == Checked::kMostBlanks)
      full_ = true;
    else
      checked_.blanks[checked_.blank_count++] = static_cast<std::uint32_t>(base_ + position);
  }
  void from(std::size_t base) { base_ = base; }
  bool full() const { return full_; }

 private:
  Checked& checked_;
  std::size_t base_;
  bool full_ = false;
};

bool is_number(std::int64_t value) {
  return value >= 0 && value <= kHighestNumber;
}

// A bitmap: how many bits, then the words that hold them.
bool bits_fit(Reader& reader) {
  constexpr std::uint32_t kMostBits = 256;
  const std::uint32_t bits = reader.u32();
  if (bits > kMostBits) return false;
  reader.skip((bits + 31) / 32 * 4);
  return reader.ok();
}

constexpr std::size_t kEntities = 8;  // reader and writer

Fault fault_unless(bool fits, Fault fault) {
  return fits ? Fault::kNone : fault;
}

Fault check_heartbeat(Reader reader) {
  reader.skip(kEntities);
  const std::int64_t first = reader.sequence_number(), last = reader.sequence_number();
  reader.u32();  // its count
  return fault_unless(reader.ok() && is_number(first) && is_number(last) && last >= first - 1,
                      Fault::kSequence);
}

Fault check_ack_nack(Reader reader) {
  reader.skip(kEntities);
  const bool set_fits = is_number(reader.sequence_number()) && bits_fit(reader);
  reader.u32();
  return fault_unless(set_fits && reader.ok(), Fault::kSequence);
}

Fault check_gap(Reader reader) {
  reader.skip(kEntities);
  const std::int64_t first = reader.sequence_number(), base = reader.sequence_number();
  const bool range_fits = first > 0 && is_number(first) && is_number(base) && base >= first &&
                          base - first <= kLongestGap;
  return fault_unless(range_fits && bits_fit(reader) && reader.ok(), Fault::kSequence);
}

Fault check_nack_fragments(Reader reader) {
  reader.skip(kEntities);
  const std::int64_t number = reader.sequence_number();
  const std::uint32_t first = reader.u32();
  const bool set_fits = number > 0 && is_number(number) && first > 0 && bits_fit(reader);
  reader.u32();
  return fault_unless(set_fits && reader.ok(), Fault::kSequence);
}

Fault check_heartbeat_fragments(Reader reader) {
  reader.skip(kEntities);
  const std::int64_t number = reader.sequence_number();
  reader.skip(8);  // last fragment, count
  return fault_unless(reader.ok() && number > 0 && is_number(number), Fault::kSequence);
}

struct SampleHeader {
  bool fits = false;
  std::uint32_t reader = 0, writer = 0;
};

// From the extra flags to the sequence number. `least` is where inline parameters begin at the
// earliest, counted from behind that number itself.
SampleHeader sample_header(Reader& reader, std::uint16_t least, std::uint16_t& to_inline) {
  reader.skip(2);
  to_inline = reader.u16();
  SampleHeader result;
  result.reader = reader.id();
  result.writer = reader.id();
  const std::int64_t number = reader.sequence_number();
  result.fits = reader.ok() && number > 0 && is_number(number) && to_inline >= least &&
                to_inline % 4 == 0 && to_inline < 0x8000;
  return result;
}

// The writer's form counts, and the reader's where it is named; they may not contradict.
bool payload_fits(const SampleHeader& header, Reader reader, MessageBlanks& blanks) {
  const Form form = form_of(header.writer), of_reader = form_of(header.reader);
  if (header.reader != 0 && of_reader != form) return false;
  return check_payload(form, reader.rest(), blanks);
}

Fault check_data(const Submessage& submessage, Checked& checked) {
  constexpr std::uint16_t kToInline = 16;
  Reader reader(submessage.content, submessage.little_endian());
  std::uint16_t to_inline = 0;
  const SampleHeader header = sample_header(reader, kToInline, to_inline);
  if (!header.fits) return Fault::kData;
  reader.skip(to_inline - kToInline);
  MessageBlanks blanks(checked, submessage.position);
  if (submessage.has(kInlineFlag) && !check_parameters(reader, blanks)) return Fault::kData;
  const bool data = submessage.has(kDataFlag), key = submessage.has(kKeyFlag);
  if (!reader.ok() || (data && key)) return Fault::kData;
  if ((data || key) && reader.left() < 4) return Fault::kData;
  blanks.from(submessage.position + reader.position());
  if (data && !payload_fits(header, reader, blanks)) return Fault::kDiscovery;
  if (data && header.writer == kParticipantWriter && !has_identity(reader.rest()))
    checked.of_stranger = true;
  return fault_unless(!blanks.full(), Fault::kDiscovery);
}

struct Fragments {
  std::uint32_t first, count, size_B, sample_B;
};

// The library's list has its last entry at the start of the last fragment.
bool fragments_fit(const Fragments& f, std::size_t payload_B) {
  if (f.first == 0 || f.count == 0 || f.size_B < kSmallestFragment_B) return false;
  if (f.sample_B == 0 || f.sample_B > kLargestSample_B) return false;
  const std::uint64_t all = (std::uint64_t{f.sample_B} + f.size_B - 1) / f.size_B;
  const std::uint64_t begin = std::uint64_t{f.size_B} * (f.first - 1);
  if (std::uint64_t{f.first} + f.count - 1 > all) return false;
  if (((all - 1) * f.size_B + 3) / 4 * 4 + 4 > f.sample_B) return false;
  return payload_B >=
         std::min<std::uint64_t>(std::uint64_t{f.count} * f.size_B, f.sample_B - begin);
}

Fault check_data_fragments(const Submessage& submessage, Checked& checked) {
  constexpr std::uint16_t kToInline = 28;
  Reader reader(submessage.content, submessage.little_endian());
  std::uint16_t to_inline = 0;
  const SampleHeader header = sample_header(reader, kToInline, to_inline);
  Fragments fragments{};
  fragments.first = reader.u32();
  fragments.count = reader.u16();
  fragments.size_B = reader.u16();
  fragments.sample_B = reader.u32();
  if (!header.fits || !reader.ok() || submessage.has(kFragmentKeyFlag)) return Fault::kFragment;
  // In pieces, what they carry cannot be judged; it is small, and everybody sends it whole.
  if (form_of(header.writer) != Form::kFree || form_of(header.reader) != Form::kFree)
    return Fault::kDiscovery;
  reader.skip(to_inline - kToInline);
  MessageBlanks blanks(checked, submessage.position);
  if (submessage.has(kInlineFlag) && !check_parameters(reader, blanks)) return Fault::kData;
  return fault_unless(reader.ok() && !blanks.full() && fragments_fit(fragments, reader.left()),
                      Fault::kFragment);
}

Fault check_info(const Submessage& submessage) {
  const std::size_t size = submessage.content.size();
  if (submessage.id == kInfoSource) return fault_unless(size == 20, Fault::kFrame);
  if (submessage.id == kInfoDestination) return fault_unless(size >= 12, Fault::kFrame);
  return fault_unless(submessage.has(kNoTimeFlag) || size >= 8, Fault::kFrame);
}

// Lengths of the cipher text and of the list of codes are big-endian in the standard's plugin. The
// library deciphers so many bytes, before it knows who sent them.
Fault check_security(const Submessage& submessage) {
  constexpr std::size_t kHeader = 20, kCode = 16, kOfReceiver = 20;
  Reader reader(submessage.content, false);
  if (submessage.id == kSecurePrefix || submessage.id == kSecureMessagePrefix)
    return fault_unless(submessage.content.size() == kHeader, Fault::kSecurity);
  if (submessage.id == kSecureBody) {
    const std::uint32_t length = reader.u32();
    return fault_unless(reader.ok() && length <= reader.left() && reader.left() - length < 4,
                        Fault::kSecurity);
  }
  reader.skip(kCode);
  const std::uint32_t receivers = reader.u32();
  return fault_unless(
      reader.ok() && receivers == reader.left() / kOfReceiver && reader.left() % kOfReceiver == 0,
      Fault::kSecurity);
}

}  // namespace

Fault check_submessage(const Submessage& submessage, Checked& checked) {
  const Reader reader(submessage.content, submessage.little_endian());
  switch (submessage.id) {
    case kNone:
      return Fault::kFrame;
    case kData:
      return check_data(submessage, checked);
    case kDataFragments:
      return check_data_fragments(submessage, checked);
    case kHeartbeat:
      return check_heartbeat(reader);
    case kAckNack:
      return check_ack_nack(reader);
    case kGap:
      return check_gap(reader);
    case kNackFragments:
      return check_nack_fragments(reader);
    case kHeartbeatFragments:
      return check_heartbeat_fragments(reader);
    case kInfoTimestamp:
    case kInfoSource:
    case kInfoDestination:
      return check_info(submessage);
    case kSecureBody:
    case kSecurePrefix:
    case kSecurePostfix:
    case kSecureMessagePrefix:
    case kSecureMessagePostfix:
      return check_security(submessage);
    default:
      return Fault::kNone;
  }
}

}  // namespace foretrack::wire
