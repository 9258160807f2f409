// SPDX-License-Identifier: Apache-2.0
// Good RTPS messages, and bad ones made of them: seeded, and aware of what a message is made of.
#pragma once

#include <cstdint>
#include <map>
#include <mutex>
#include <string>
#include <vector>

#include "core/common/random.hpp"
#include "tests/fuzz/mutate.hpp"

namespace foretrack::testing {

using Message = std::vector<std::uint8_t>;

/// What was seen on the way, some of each kind. From any thread.
class Seeds {
 public:
  void add(const std::uint8_t* bytes, std::size_t size);
  std::size_t size() const;
  Message one(Random& random) const;

 private:
  static constexpr std::size_t kOfAKind = 24, kMost = 2000;
  mutable std::mutex mutex_;
  std::map<std::string, std::size_t> kinds_;
  std::vector<Message> messages_;
};

/// The same seed and the same good messages make the same bad ones.
class BadMessages {
 public:
  BadMessages(std::uint64_t seed, const Seeds& seeds)
      : random_(seed), bytes_(random_.next()), seeds_(seeds) {}
  Message next();

 private:
  void change(Message& message);
  void edge(Message& message);
  void relabel(Message& message);
  void resize(Message& message);
  void splice(Message& message);
  void repeat(Message& message);
  void parameter(Message& message);

  Random random_;
  Mutator bytes_;
  const Seeds& seeds_;
};

}  // namespace foretrack::testing
