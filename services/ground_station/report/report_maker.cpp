// SPDX-License-Identifier: Apache-2.0
#include "services/ground_station/report/report_maker.hpp"

#include <exception>

#include "services/ground_station/report/write_report.hpp"

namespace foretrack::station {
namespace {

Response make_report(const std::filesystem::path& recording) try {
  Response response = text_response(200, report_html(read_story(recording)));
  response.type = "text/html; charset=utf-8";
  return response;
} catch (const std::exception& error) {
  return text_response(422, error.what());
}

}  // namespace

ReportMaker::~ReportMaker() {
  if (thread_.joinable()) thread_.join();
}

void ReportMaker::make(const std::filesystem::path& recording, const Respond& respond) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(recording, error))
    return respond(text_response(404, "there is no such recording"));
  if (busy_) return respond(text_response(503, "another report is being made"));
  if (thread_.joinable()) thread_.join();
  busy_ = true;
  thread_ = std::thread([this, recording, respond] {
    post_([this, respond, response = make_report(recording)]() mutable {
      busy_ = false;
      respond(std::move(response));
    });
  });
}

}  // namespace foretrack::station
