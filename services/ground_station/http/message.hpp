// SPDX-License-Identifier: Apache-2.0
// A request and its answer, without the library that carries them.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace foretrack::station {

struct Request {
  std::string method;  // "GET"
  std::string path;    // decoded, without the query: "/api/status"
  std::string query;   // "token=…"
  std::string host, origin, authorization, range;
  std::string body;
  std::string remote;  // "127.0.0.1:50123"
};

/// A part of a file, read while it is sent.
struct FilePart {
  std::filesystem::path path;
  std::uint64_t begin = 0, end = 0;  // bytes, end exclusive
};

struct Response {
  int status = 200;
  std::string type = "text/plain; charset=utf-8";
  std::string body;
  std::optional<FilePart> file;  // instead of the body
  std::vector<std::pair<std::string, std::string>> headers;
};

using Respond = std::function<void(Response)>;
/// Answers now or later, in the server's thread, exactly once.
using Handler = std::function<void(const Request&, Respond)>;

Response text_response(int status, std::string text);
Response json_response(int status, std::string text);

}  // namespace foretrack::station
