// SPDX-License-Identifier: Apache-2.0
#include "tests/fuzz/bus/datagrams.hpp"

#include <algorithm>

namespace foretrack::testing {
namespace {

constexpr std::size_t kHeader = 20, kFrame = 4;

std::size_t u16_at(const Message& m, std::size_t at, bool little) {
  return little ? m[at] | m[at + 1] << 8 : m[at] << 8 | m[at + 1];
}

// Where submessages begin; the last number is the message's end.
std::vector<std::size_t> starts(const Message& m) {
  std::vector<std::size_t> result;
  std::size_t at = kHeader;
  while (at + kFrame <= m.size()) {
    result.push_back(at);
    const std::size_t length = u16_at(m, at + 2, m[at + 1] & 1);
    if (length == 0 && m[at] != 1 && m[at] != 9) break;
    at += kFrame + (length + 3) / 4 * 4;
  }
  result.push_back(m.size());
  return result;
}

std::size_t pick(Random& random, std::size_t count) {
  return count == 0 ? 0 : static_cast<std::size_t>(random.integer(0, static_cast<int>(count) - 1));
}

// Two starts that enclose one submessage; both the end, if there is none.
std::pair<std::size_t, std::size_t> one_of(const Message& m, Random& random) {
  const auto all = starts(m);
  if (all.size() < 2) return {m.size(), m.size()};
  const std::size_t i = pick(random, all.size() - 1);
  return {std::min(all[i], m.size()), std::min(all[i + 1], m.size())};
}

}  // namespace

void Seeds::add(const std::uint8_t* bytes, std::size_t size) {
  if (size < kHeader) return;
  Message message(bytes, bytes + size);
  std::string kind;
  for (const std::size_t at : starts(message)) {
    if (at + kFrame > size) break;
    kind += static_cast<char>(message[at]);
    // Samples differ by who writes them.
    if (message[at] == 0x15 && at + 16 <= size)
      kind.append(message.begin() + static_cast<std::ptrdiff_t>(at) + 12,
                  message.begin() + static_cast<std::ptrdiff_t>(at) + 16);
  }
  const std::lock_guard lock(mutex_);
  if (messages_.size() < kMost && kinds_[kind]++ < kOfAKind) messages_.push_back(message);
}

std::size_t Seeds::size() const {
  const std::lock_guard lock(mutex_);
  return messages_.size();
}

Message Seeds::one(Random& random) const {
  const std::lock_guard lock(mutex_);
  return messages_.empty() ? Message(kHeader) : messages_[pick(random, messages_.size())];
}

Message BadMessages::next() {
  Message message = seeds_.one(random_);
  const int changes = random_.integer(1, 3);
  for (int i = 0; i < changes; ++i) change(message);
  constexpr std::size_t kMostOfUdp = 65000;
  if (message.size() > kMostOfUdp) message.resize(kMostOfUdp);
  return message;
}

void BadMessages::change(Message& message) {
  switch (random_.integer(0, 7)) {
    case 0: {
      // The header stays good, so that what follows is read.
      const Message header(message.begin(), message.begin() + static_cast<std::ptrdiff_t>(std::min(
                                                                  kHeader, message.size())));
      message = bytes_.mutate(message);
      message.resize(std::max(message.size(), kHeader));
      std::copy(header.begin(), header.end(), message.begin());
      return;
    }
    case 1:
    case 2:
      return edge(message);
    case 3:
      return relabel(message);
    case 4:
      return resize(message);
    case 5:
      return splice(message);
    case 6:
      return repeat(message);
    default:
      return parameter(message);
  }
}

// A number that is the last or first of something, at a place where one may stand.
void BadMessages::edge(Message& message) {
  const auto [begin, end] = one_of(message, random_);
  if (end < begin + kFrame + 4) return;
  constexpr std::uint32_t kEdges[] = {
      0,      1,      2,       3,          4,          0xff,       0x100,      0x101,     0x7fff,
      0x8000, 0xffff, 0x10000, 0x7ffffffe, 0x7fffffff, 0x80000000, 0xfffffffe, 0xffffffff};
  const std::uint32_t value = kEdges[pick(random_, std::size(kEdges))];
  const std::size_t at = begin + kFrame + 4 * pick(random_, (end - begin - kFrame) / 4);
  const bool little = random_.chance(0.8);
  for (std::size_t i = 0; i < 4 && at + i < message.size(); ++i)
    message[at + i] = static_cast<std::uint8_t>(value >> 8 * (little ? i : 3 - i));
}

void BadMessages::relabel(Message& message) {
  const auto [begin, end] = one_of(message, random_);
  if (end < begin + kFrame) return;
  constexpr std::uint8_t kIds[] = {0x01, 0x06, 0x07, 0x08, 0x09, 0x0c, 0x0d, 0x0e,
                                   0x0f, 0x12, 0x13, 0x15, 0x16, 0x30, 0x31, 0x32,
                                   0x33, 0x34, 0x80, 0x81, 0x00, 0x50};
  if (random_.chance(0.5))
    message[begin] = kIds[pick(random_, std::size(kIds))];
  else
    message[begin + 1] ^= static_cast<std::uint8_t>(1 << random_.integer(0, 4));
}

void BadMessages::resize(Message& message) {
  const auto [begin, end] = one_of(message, random_);
  if (end < begin + kFrame) return;
  const int change = random_.integer(-5, 5) * (random_.chance(0.5) ? 4 : 1);
  const std::size_t length =
      u16_at(message, begin + 2, message[begin + 1] & 1) + static_cast<std::size_t>(change);
  const bool little = message[begin + 1] & 1;
  message[begin + (little ? 2 : 3)] = static_cast<std::uint8_t>(length);
  message[begin + (little ? 3 : 2)] = static_cast<std::uint8_t>(length >> 8);
  // With the bytes that it then has, or without.
  const auto at = message.begin() + static_cast<std::ptrdiff_t>(end);
  if (random_.chance(0.3)) return;
  if (change > 0)
    message.insert(at, static_cast<std::size_t>(change), 0);
  else if (end - begin > static_cast<std::size_t>(kFrame) + static_cast<std::size_t>(-change))
    message.erase(at + change, at);
}

// A submessage of another message, before one of this.
void BadMessages::splice(Message& message) {
  const Message other = seeds_.one(random_);
  const auto [begin, end] = one_of(other, random_);
  const std::size_t at = one_of(message, random_).first;
  message.insert(message.begin() + static_cast<std::ptrdiff_t>(at),
                 other.begin() + static_cast<std::ptrdiff_t>(begin),
                 other.begin() + static_cast<std::ptrdiff_t>(end));
}

void BadMessages::repeat(Message& message) {
  const auto [begin, end] = one_of(message, random_);
  const Message one(message.begin() + static_cast<std::ptrdiff_t>(begin),
                    message.begin() + static_cast<std::ptrdiff_t>(end));
  const auto at = message.begin() + static_cast<std::ptrdiff_t>(begin);
  if (random_.chance(0.3))
    message.erase(at, at + static_cast<std::ptrdiff_t>(one.size()));
  else
    message.insert(at, one.begin(), one.end());
}

// Of discovery: another id or length for one, or one more in front of the first. Lists begin behind
// a sample's header (24 bytes) and its encapsulation.
void BadMessages::parameter(Message& message) {
  const auto [begin, end] = one_of(message, random_);
  constexpr std::size_t kToFirst = 28;
  if (end < begin + kToFirst + 8 || message[begin] != 0x15) return edge(message);
  std::size_t at = begin + kToFirst;
  for (int skip = random_.integer(0, 12); skip > 0; --skip) {
    const std::size_t next = at + 4 + u16_at(message, at + 2, true);
    if (next + 8 > end) break;
    at = next;
  }
  constexpr std::uint16_t kIds[] = {
      0x02, 0x04, 0x05, 0x06,   0x07,   0x15,   0x16,   0x1a,   0x1b,   0x1d,   0x1e,   0x1f,  0x21,
      0x23, 0x25, 0x27, 0x29,   0x2b,   0x2c,   0x2d,   0x2e,   0x2f,   0x30,   0x31,   0x32,  0x33,
      0x35, 0x43, 0x48, 0x50,   0x58,   0x59,   0x5a,   0x62,   0x69,   0x70,   0x71,   0x72,  0x73,
      0x74, 0x75, 0x77, 0x1001, 0x1002, 0x1004, 0x1005, 0x1006, 0x8002, 0x8005, 0x8006, 0x800f};
  const std::uint16_t id = kIds[pick(random_, std::size(kIds))];
  if (random_.chance(0.6)) {
    message[at] = static_cast<std::uint8_t>(id);
    message[at + 1] = static_cast<std::uint8_t>(id >> 8);
  } else {
    message[at + 2] = static_cast<std::uint8_t>(4 * random_.integer(0, 20));
    message[at + 3] = 0;
  }
  if (random_.chance(0.5))
    for (std::size_t i = at + 4; i < std::min(at + 12, end); ++i)
      message[i] = static_cast<std::uint8_t>(random_.chance(0.5) ? 0 : random_.integer(0, 255));
}

}  // namespace foretrack::testing
