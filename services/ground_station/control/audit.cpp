// SPDX-License-Identifier: Apache-2.0
#include "services/ground_station/control/audit.hpp"

#include <fcntl.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "services/common/time_now.hpp"

namespace foretrack::station {

Audit::Audit(const std::filesystem::path& path) {
  std::error_code error;
  std::filesystem::create_directories(path.parent_path(), error);
  fd_ = ::open(path.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0600);
  if (fd_ < 0)
    throw std::runtime_error("cannot write the audit log " + path.string() + ": " +
                             std::strerror(errno));
}

Audit::~Audit() {
  ::close(fd_);
}

void Audit::note(const std::map<std::string, std::string>& facts) {
  nlohmann::ordered_json line;
  line["time_s"] = 1e-9 * static_cast<double>(now_ns());
  for (const auto& [key, value] : facts) line[key] = value;
  const auto text =
      line.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + '\n';
  if (::write(fd_, text.data(), text.size()) != static_cast<ssize_t>(text.size()))
    spdlog::error("the audit log was not written: {}", std::strerror(errno));
}

}  // namespace foretrack::station
