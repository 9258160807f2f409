// SPDX-License-Identifier: Apache-2.0
// Between the library's requests and ours, the same for every kind of stream.
#pragma once

#include <fstream>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "services/ground_station/http/beast.hpp"
#include "services/ground_station/http/guard.hpp"
#include "services/ground_station/http/message.hpp"

namespace foretrack::station {

using BeastRequest = http::request<http::string_body>;
using BeastResponse = http::response<http::string_body>;

Request to_request(const BeastRequest& request, const std::string& remote);

/// The answer to who may not ask; none: may.
std::optional<Response> refuse(const GuardOptions& guard, const Request& request);

/// With the headers that keep browsers careful, and the length of the file's part if there is one.
BeastResponse to_head(Response& response, const std::optional<FilePart>& file, unsigned version,
                      bool keep_alive, const Request& request, bool tls);

/// Reads a part of a file piece by piece.
class FileReader {
 public:
  explicit FileReader(const FilePart& part);
  bool good() const { return stream_.good(); }
  /// Empty: all was read, or the file ended early. Valid until the next call.
  std::span<const char> next();
  bool complete() const { return left_ == 0; }

 private:
  std::ifstream stream_;
  std::uint64_t left_;
  std::vector<char> piece_;
};

}  // namespace foretrack::station
