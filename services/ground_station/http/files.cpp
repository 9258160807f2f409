// SPDX-License-Identifier: Apache-2.0
#include "services/ground_station/http/files.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <optional>

namespace foretrack::station {
namespace {

namespace fs = std::filesystem;

constexpr std::array<std::pair<std::string_view, std::string_view>, 12> kTypes = {{
    {".html", "text/html; charset=utf-8"},
    {".js", "text/javascript; charset=utf-8"},
    {".css", "text/css; charset=utf-8"},
    {".json", "application/json"},
    {".map", "application/json"},
    {".svg", "image/svg+xml"},
    {".png", "image/png"},
    {".jpg", "image/jpeg"},
    {".ico", "image/x-icon"},
    {".woff2", "font/woff2"},
    {".wasm", "application/wasm"},
    {".mcap", "application/octet-stream"},
}};

std::string_view type_of(const fs::path& path) {
  const auto extension = path.extension().string();
  for (const auto& [known, type] : kTypes)
    if (known == extension) return type;
  return "application/octet-stream";
}

// The real file, if it is inside the folder.
std::optional<fs::path> find_inside(const fs::path& folder, std::string_view request_path) {
  std::error_code error;
  const fs::path root = fs::canonical(folder, error);
  if (error || request_path.find('\0') != std::string_view::npos) return std::nullopt;
  const auto relative = request_path == "/" ? "index.html" : request_path.substr(1);
  const fs::path file = fs::canonical(root / relative, error);
  if (error || !fs::is_regular_file(file, error)) return std::nullopt;
  const auto [end, unused] = std::mismatch(root.begin(), root.end(), file.begin(), file.end());
  if (end != root.end()) return std::nullopt;
  return file;
}

std::optional<std::uint64_t> number(std::string_view text) {
  std::uint64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

// "bytes=0-99", "bytes=100-", "bytes=-8"; none if it is not one range of the file.
std::optional<std::pair<std::uint64_t, std::uint64_t>> parse_range(std::string_view text,
                                                                   std::uint64_t size) {
  constexpr std::string_view kUnit = "bytes=";
  if (!text.starts_with(kUnit)) return std::nullopt;
  text.remove_prefix(kUnit.size());
  const auto dash = text.find('-');
  if (dash == std::string_view::npos) return std::nullopt;
  const auto first = number(text.substr(0, dash));
  const auto last = number(text.substr(dash + 1));
  if (!first && !last) return std::nullopt;
  const std::uint64_t begin = first ? *first : size - std::min(size, *last);
  const std::uint64_t end = first && last ? std::min(size, *last + 1) : size;
  if (begin >= end || (last && first && *last < *first)) return std::nullopt;
  return std::pair{begin, end};
}

}  // namespace

Response serve_file(const fs::path& folder, std::string_view request_path, std::string_view range,
                    bool cached) {
  const auto path = find_inside(folder, request_path);
  if (!path) return text_response(404, "there is no such file");
  std::error_code error;
  const std::uint64_t size = fs::file_size(*path, error);
  if (error) return text_response(404, "there is no such file");
  Response response;
  response.type = type_of(*path);
  response.file = FilePart{*path, 0, size};
  response.headers = {{"Accept-Ranges", "bytes"},
                      {"Cache-Control", cached ? "max-age=31536000, immutable" : "no-cache"}};
  if (range.empty()) return response;
  const auto part = parse_range(range, size);
  if (!part) {
    response = text_response(416, "no such range");
    response.headers = {{"Content-Range", "bytes */" + std::to_string(size)}};
    return response;
  }
  response.status = 206;
  response.file->begin = part->first;
  response.file->end = part->second;
  response.headers.emplace_back("Content-Range", "bytes " + std::to_string(part->first) + '-' +
                                                     std::to_string(part->second - 1) + '/' +
                                                     std::to_string(size));
  return response;
}

}  // namespace foretrack::station
