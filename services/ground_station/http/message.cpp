// SPDX-License-Identifier: Apache-2.0
#include "services/ground_station/http/message.hpp"

namespace foretrack::station {

Response text_response(int status, std::string text) {
  Response response;
  response.status = status;
  response.body = std::move(text) + '\n';
  return response;
}

Response json_response(int status, std::string text) {
  Response response;
  response.status = status;
  response.type = "application/json";
  response.body = std::move(text);
  response.headers = {{"Cache-Control", "no-store"}};
  return response;
}

}  // namespace foretrack::station
