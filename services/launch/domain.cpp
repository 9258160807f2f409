// SPDX-License-Identifier: Apache-2.0
#include "services/launch/domain.hpp"

#include <fmt/format.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <cstddef>
#include <fstream>
#include <random>
#include <sstream>
#include <stdexcept>
#include <string>

namespace foretrack {
namespace {

constexpr int kFirst = 1, kLast = 100;  // above, ports meet those that the kernel hands out
constexpr int kPortBase = 7400, kPortsPerDomain = 250;

// A name in the kernel's abstract socket space: one owner at a time, freed however that one ends.
int claim(int domain) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  const std::string name = fmt::format("foretrack-domain-{}", domain);
  std::copy(name.begin(), name.end(), address.sun_path + 1);  // behind a zero: no file
  const int file = socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  const auto size = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + 1 + name.size());
  if (file >= 0 && bind(file, reinterpret_cast<const sockaddr*>(&address), size) == 0) return file;
  if (file >= 0) close(file);
  return -1;
}

}  // namespace

bool domain_is_in_use(int domain) {
  const int first = kPortBase + kPortsPerDomain * domain;
  for (const char* table : {"/proc/net/udp", "/proc/net/udp6"}) {
    std::ifstream file(table);
    std::string line;
    std::getline(file, line);  // the heading
    while (std::getline(file, line)) {
      std::istringstream words(line);
      std::string slot, address;
      words >> slot >> address;
      const auto colon = address.rfind(':');
      if (colon == std::string::npos) continue;
      const int port = std::stoi(address.substr(colon + 1), nullptr, 16);
      if (port >= first && port < first + kPortsPerDomain) return true;
    }
  }
  return false;
}

FreeDomain::FreeDomain() {
  std::random_device random;  // two programs that start together should not try the same ones
  constexpr int kCount = kLast - kFirst + 1;
  const int start = static_cast<int>(random() % kCount);
  for (int i = 0; i < kCount; ++i) {
    const int domain = kFirst + (start + i) % kCount;
    claim_ = claim(domain);
    if (claim_ < 0) continue;
    if (!domain_is_in_use(domain)) {
      id_ = domain;
      return;
    }
    close(claim_);
  }
  throw std::runtime_error("no free DDS domain; name one with --domain");
}

FreeDomain::~FreeDomain() {
  close(claim_);
}

}  // namespace foretrack
