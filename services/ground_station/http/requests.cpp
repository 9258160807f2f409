// SPDX-License-Identifier: Apache-2.0
#include "services/ground_station/http/requests.hpp"

#include <algorithm>

namespace foretrack::station {
namespace {

constexpr std::size_t kPieceBytes = 128 * 1024;

std::optional<char> unhex(std::string_view two) {
  int value = 0;
  for (const char c : two) {
    value *= 16;
    if (c >= '0' && c <= '9')
      value += c - '0';
    else if (c >= 'a' && c <= 'f')
      value += c - 'a' + 10;
    else if (c >= 'A' && c <= 'F')
      value += c - 'A' + 10;
    else
      return std::nullopt;
  }
  return static_cast<char>(value);
}

// What is not a valid escape stays as it is.
std::string decode(std::string_view text) {
  std::string result;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto c =
        text[i] == '%' && i + 2 < text.size() ? unhex(text.substr(i + 1, 2)) : std::nullopt;
    result += c ? *c : text[i];
    if (c) i += 2;
  }
  return result;
}

std::string security_policy(const Request& request, bool tls) {
  return "default-src 'self'; script-src 'self'; style-src 'self' 'unsafe-inline'; img-src 'self' "
         "data: blob:; worker-src 'self'; connect-src 'self' " +
         std::string(tls ? "wss://" : "ws://") + request.host +
         "; object-src 'none'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'";
}

}  // namespace

Request to_request(const BeastRequest& in, const std::string& remote) {
  Request out;
  out.method = std::string(in.method_string());
  const std::string target(in.target());
  const auto mark = target.find('?');
  out.path = decode(std::string_view(target).substr(0, mark));
  if (mark != std::string::npos) out.query = target.substr(mark + 1);
  out.host = std::string(in[http::field::host]);
  out.origin = std::string(in[http::field::origin]);
  out.authorization = std::string(in[http::field::authorization]);
  out.range = std::string(in[http::field::range]);
  out.body = in.body();
  out.remote = remote;
  return out;
}

std::optional<Response> refuse(const GuardOptions& guard, const Request& request) {
  if (const auto why = refusal_of_host(guard, request); !why.empty())
    return text_response(421, why);
  if (const auto why = refusal_of_origin(guard, request); !why.empty())
    return text_response(403, why);
  if (!request.path.starts_with('/')) return text_response(400, "a path expected");
  return std::nullopt;
}

BeastResponse to_head(Response& response, const std::optional<FilePart>& file, unsigned version,
                      bool keep_alive, const Request& request, bool tls) {
  BeastResponse out(static_cast<http::status>(response.status), version);
  out.set(http::field::server, "foretrack");
  out.set(http::field::content_type, response.type);
  out.set("Content-Security-Policy", security_policy(request, tls));
  out.set("X-Content-Type-Options", "nosniff");
  out.set("Referrer-Policy", "no-referrer");
  out.set("Cross-Origin-Opener-Policy", "same-origin");
  out.set("Cross-Origin-Resource-Policy", "same-origin");
  for (const auto& [name, value] : response.headers) out.set(name, value);
  out.keep_alive(keep_alive);
  if (file) {
    out.content_length(file->end - file->begin);
  } else {
    out.content_length(response.body.size());
    if (request.method != "HEAD") out.body() = std::move(response.body);
  }
  return out;
}

FileReader::FileReader(const FilePart& part)
    : stream_(part.path, std::ios::binary), left_(part.end - part.begin), piece_(kPieceBytes) {
  stream_.seekg(static_cast<std::streamoff>(part.begin));
}

std::span<const char> FileReader::next() {
  const auto wanted = std::min<std::uint64_t>(left_, piece_.size());
  stream_.read(piece_.data(), static_cast<std::streamsize>(wanted));
  const auto got = static_cast<std::size_t>(stream_.gcount());
  left_ -= got;
  return {piece_.data(), got};
}

}  // namespace foretrack::station
