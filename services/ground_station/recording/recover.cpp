// SPDX-License-Identifier: Apache-2.0
#include "services/ground_station/recording/recover.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <stdexcept>

#include "core/version.hpp"
#include "services/ground_station/mcap/reader.hpp"
#include "services/ground_station/mcap/writer.hpp"

namespace foretrack::station {
namespace {

namespace fs = std::filesystem;

bool is_complete(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::uint8_t end[sizeof mcap::kMagic] = {};
  file.seekg(-static_cast<std::streamoff>(sizeof end), std::ios::end);
  file.read(reinterpret_cast<char*>(end), sizeof end);
  return file && std::equal(std::begin(end), std::end(end), std::begin(mcap::kMagic));
}

// A recorder holds a lock on the file that it writes.
bool is_being_written(const fs::path& path) {
  const int fd = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (fd < 0) return true;
  const bool locked = ::flock(fd, LOCK_EX | LOCK_NB) != 0;
  ::close(fd);
  return locked;
}

void rewrite(const fs::path& from, const fs::path& to) {
  mcap::Reader reader(from);
  std::ofstream out(to, std::ios::binary);
  mcap::Writer writer(
      [&](std::span<const std::uint8_t> piece) {
        out.write(reinterpret_cast<const char*>(piece.data()),
                  static_cast<std::streamsize>(piece.size()));
        return out.good();
      },
      std::string("foretrack ") + kVersion);
  std::map<std::uint16_t, std::uint16_t> ids;
  bool first = true;
  while (const auto message = reader.next()) {
    if (first)
      for (const auto& [name, values] : reader.metadata()) writer.add_metadata(name, values);
    first = false;
    auto& id = ids[message->channel];
    if (id == 0) id = writer.add_channel(reader.channels().at(message->channel));
    writer.write(id, message->log_time_ns, message->data);
  }
  writer.finish();
  if (!writer.good() || !out.flush()) throw std::runtime_error("cannot write " + to.string());
}

}  // namespace

int recover_recordings(const fs::path& folder) {
  int recovered = 0;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    const auto& path = entry.path();
    if (path.extension() != ".mcap" || is_complete(path) || is_being_written(path)) continue;
    const fs::path part = path.string() + ".part";
    try {
      rewrite(path, part);
      fs::rename(part, path);
      ++recovered;
    } catch (const std::exception&) {  // it stays as it is
      fs::remove(part, error);
    }
  }
  return recovered;
}

}  // namespace foretrack::station
