// SPDX-License-Identifier: Apache-2.0
// A participant that speaks with the one under attack, and keeps what it sends: good messages, with
// ids that the other one knows.
#pragma once

#include <memory>
#include <string>

#include "tests/fuzz/bus/datagrams.hpp"

namespace foretrack::testing {

class Peer {
 public:
  /// Joins as qos/profiles.xml has it, on the loopback interface; the identity's folder may be
  /// empty.
  Peer(int domain, std::shared_ptr<Seeds> seeds, const std::string& identity);
  ~Peer();

  /// A sample on every topic that it writes.
  void write();
  /// Samples that came from the other one since the last call.
  int heard();

  /// Is the one under attack instead, until it is killed: readers and writers of every profile,
  /// behind the filter, or without it.
  [[noreturn]] static void be_the_victim(int domain, bool filtered, const std::string& identity);

 private:
  struct Dds;
  std::unique_ptr<Dds> dds_;
};

}  // namespace foretrack::testing
