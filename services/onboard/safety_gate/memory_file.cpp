// SPDX-License-Identifier: Apache-2.0
#include "services/onboard/safety_gate/memory_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <span>

namespace foretrack {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kMagic = 0x65746167'66747266;  // "frtfgate"

struct Header {
  std::uint64_t magic = kMagic;
  std::uint64_t size = sizeof(GateMemory);
  std::uint64_t checksum = 0;
};

using Image = std::array<char, sizeof(Header) + sizeof(GateMemory)>;

// FNV-1a: against a torn or rotten file, not against forgers, who could write another one.
std::uint64_t checksum_of(std::span<const char> bytes) {
  std::uint64_t sum = 14695981039346656037ull;
  for (const char byte : bytes) sum = (sum ^ static_cast<unsigned char>(byte)) * 1099511628211ull;
  return sum;
}

Image image_of(const GateMemory& memory) {
  Image image{};
  std::memcpy(image.data() + sizeof(Header), &memory, sizeof memory);
  Header header;
  header.checksum = checksum_of(std::span(image).subspan(sizeof(Header)));
  std::memcpy(image.data(), &header, sizeof header);
  return image;
}

bool write_all(int fd, std::span<const char> bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(fd, bytes.data(), bytes.size());
    if (written <= 0) return false;
    bytes = bytes.subspan(static_cast<std::size_t>(written));
  }
  return ::fsync(fd) == 0;
}

bool write_new(const fs::path& file, const Image& image) {
  const int fd = ::open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0600);
  if (fd < 0) return false;
  const bool written = write_all(fd, image);
  return ::close(fd) == 0 && written;
}

// The rename is on the disk when its folder is.
bool sync_folder(const fs::path& folder) {
  const int fd = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (fd < 0) return false;
  const bool synced = ::fsync(fd) == 0;
  ::close(fd);
  return synced;
}

}  // namespace

std::optional<GateMemory> read_memory(const fs::path& file) {
  Image image{};
  std::ifstream in(file, std::ios::binary);
  if (!in.read(image.data(), image.size()) || in.peek() != std::ifstream::traits_type::eof())
    return std::nullopt;
  Header header;
  std::memcpy(&header, image.data(), sizeof header);
  const Header expected{.checksum = checksum_of(std::span(image).subspan(sizeof(Header)))};
  if (std::memcmp(&header, &expected, sizeof header) != 0) return std::nullopt;
  GateMemory memory;
  std::memcpy(&memory, image.data() + sizeof header, sizeof memory);
  if (memory.version != GateMemory::kVersion) return std::nullopt;
  return memory;
}

bool write_memory(const fs::path& file, const GateMemory& memory) {
  std::error_code error;
  fs::create_directories(file.parent_path(), error);
  const fs::path fresh = file.string() + ".new";
  if (!write_new(fresh, image_of(memory)) || std::rename(fresh.c_str(), file.c_str()) != 0) {
    fs::remove(fresh, error);
    return false;
  }
  return sync_folder(file.parent_path());
}

}  // namespace foretrack
