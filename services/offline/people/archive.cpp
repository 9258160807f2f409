// SPDX-License-Identifier: Apache-2.0
#include "services/offline/people/archive.hpp"

#include <fmt/format.h>
#include <zip.h>

#include <stdexcept>

namespace foretrack {
namespace {

constexpr zip_uint64_t kMost_bytes = 64UL << 20;

zip_t* zip_of(void* zip) {
  return static_cast<zip_t*>(zip);
}

}  // namespace

Archive::Archive(const std::filesystem::path& file) : file_(file), zip_(nullptr) {
  int code = 0;
  zip_ = zip_open(file.c_str(), ZIP_RDONLY, &code);
  if (zip_) return;
  zip_error_t error;
  zip_error_init_with_code(&error, code);
  const std::string reason = zip_error_strerror(&error);
  zip_error_fini(&error);
  throw std::runtime_error(fmt::format("{}: {}", file.string(), reason));
}

Archive::~Archive() {
  zip_discard(zip_of(zip_));
}

std::string Archive::read(const std::string& name) const {
  const auto refuse = [&](const std::string& reason) {
    throw std::runtime_error(fmt::format("{}: {}: {}", file_.string(), name, reason));
  };
  zip_stat_t stat;
  if (zip_stat(zip_of(zip_), name.c_str(), 0, &stat) != 0) refuse("no such file in it");
  if (!(stat.valid & ZIP_STAT_SIZE) || stat.size > kMost_bytes) refuse("too large");
  zip_file_t* file = zip_fopen(zip_of(zip_), name.c_str(), 0);
  if (!file) refuse(zip_strerror(zip_of(zip_)));
  std::string bytes(stat.size, '\0');
  const zip_int64_t count = zip_fread(file, bytes.data(), bytes.size());
  const int closed = zip_fclose(file);
  if (count != static_cast<zip_int64_t>(bytes.size()) || closed != 0) refuse("damaged");
  return bytes;
}

}  // namespace foretrack
