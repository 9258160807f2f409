// SPDX-License-Identifier: Apache-2.0
#include "services/ground_station/api/file_maker.hpp"

#include <charconv>
#include <cmath>
#include <sstream>
#include <stdexcept>

#include "services/ground_station/clip/make_clip.hpp"
#include "services/ground_station/report/write_report.hpp"

namespace foretrack::station {
namespace {

double seconds_in(const std::string& name, const std::string& text) {
  double value = 0.0;
  const char* end = text.data() + text.size();
  const auto read = std::from_chars(text.data(), end, value);
  if (read.ec != std::errc() || read.ptr != end || !std::isfinite(value) || value < 0.0)
    throw std::invalid_argument("'" + name + "' is '" + text.substr(0, 32) +
                                "': seconds from the recording's beginning expected");
  return value;
}

ClipWish wish_in(const std::string& query) {
  ClipWish wish;
  std::istringstream words(query);
  for (std::string word; std::getline(words, word, '&');) {
    const auto is = word.find('=');
    const std::string name = word.substr(0, is);
    const std::string value = is == std::string::npos ? "" : word.substr(is + 1);
    if (name == "vehicle") wish.vehicle = value;
    if (name == "from_s") wish.from_s = seconds_in(name, value);
    if (name == "to_s") wish.to_s = seconds_in(name, value);
  }
  return wish;
}

Response made_or_why_not(const std::function<Response(const std::filesystem::path&)>& make,
                         const std::filesystem::path& recording) try {
  return make(recording);
} catch (const std::exception& error) {
  return text_response(422, error.what());
}

}  // namespace

Response report_of(const std::filesystem::path& recording) {
  Response response = text_response(200, report_html(read_story(recording)));
  response.type = "text/html; charset=utf-8";
  return response;
}

Response clip_of(const std::filesystem::path& recording, const std::string& query) {
  Response response = text_response(200, make_clip(recording, wish_in(query)).webm);
  response.type = "video/webm";
  return response;
}

FileMaker::~FileMaker() {
  if (thread_.joinable()) thread_.join();
}

void FileMaker::make(const std::filesystem::path& recording,
                     std::function<Response(const std::filesystem::path&)> make,
                     const Respond& respond) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(recording, error))
    return respond(text_response(404, "there is no such recording"));
  if (busy_) return respond(text_response(503, "another report or clip is being made"));
  if (thread_.joinable()) thread_.join();
  busy_ = true;
  thread_ = std::thread([this, recording, make = std::move(make), respond] {
    post_([this, respond, response = made_or_why_not(make, recording)]() mutable {
      busy_ = false;
      respond(std::move(response));
    });
  });
}

}  // namespace foretrack::station
