// SPDX-License-Identifier: Apache-2.0
#include "services/ground_station/control/tokens.hpp"

#include <fcntl.h>
#include <openssl/rand.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "services/ground_station/http/guard.hpp"

namespace foretrack::station {
namespace {

namespace fs = std::filesystem;

constexpr int kTokenBytes = 32;
constexpr std::size_t kShortest = 32;  // characters

void create(const fs::path& path) {
  std::error_code error;
  fs::create_directories(path.parent_path(), error);
  const int fd = ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
  if (fd < 0 && errno == EEXIST) return;
  const auto line = "* " + random_hex(kTokenBytes) + '\n';
  if (fd < 0 || ::write(fd, line.data(), line.size()) != static_cast<ssize_t>(line.size()))
    throw std::runtime_error("cannot write the token file " + path.string() + ": " +
                             std::strerror(errno));
  ::close(fd);
}

}  // namespace

std::string random_hex(int bytes) {
  std::string raw(static_cast<std::size_t>(bytes), '\0');
  if (RAND_bytes(reinterpret_cast<unsigned char*>(raw.data()), bytes) != 1)
    throw std::runtime_error("no random numbers");
  std::string hex;
  for (const unsigned char byte : raw) {
    hex += "0123456789abcdef"[byte >> 4];
    hex += "0123456789abcdef"[byte & 15];
  }
  return hex;
}

Tokens Tokens::load_or_create(const fs::path& path) {
  create(path);
  struct stat info {};
  if (::stat(path.c_str(), &info) != 0 || (info.st_mode & 077) != 0)
    throw std::runtime_error("the token file " + path.string() +
                             " must be readable by its owner alone (chmod 600)");
  Tokens result;
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);) {
    if (line.empty() || line.front() == '#') continue;
    std::istringstream words(line);
    std::string name, token;
    if (!(words >> name >> token) || token.size() < kShortest)
      throw std::runtime_error("the token file " + path.string() +
                               " needs lines 'operator token', tokens of 32 characters or more");
    result.tokens_.emplace_back(std::move(name), std::move(token));
  }
  if (result.tokens_.empty())
    throw std::runtime_error("the token file " + path.string() + " has no token");
  return result;
}

std::optional<std::string> Tokens::owner(std::string_view token) const {
  std::optional<std::string> found;
  for (const auto& [name, known] : tokens_)
    if (same_secret(known, token)) found = name;
  return found;
}

bool Tokens::may_act_as(std::string_view token, std::string_view operator_name) const {
  const auto name = owner(token);
  return name && (*name == "*" || *name == operator_name);
}

}  // namespace foretrack::station
