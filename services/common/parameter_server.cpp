// SPDX-License-Identifier: Apache-2.0
#include "services/common/parameter_server.hpp"

#include <spdlog/spdlog.h>

#include "rcl_interfaces/srv/DescribeParameters_Request.h"
#include "rcl_interfaces/srv/DescribeParameters_Response.h"
#include "rcl_interfaces/srv/GetParameterTypes_Request.h"
#include "rcl_interfaces/srv/GetParameterTypes_Response.h"
#include "rcl_interfaces/srv/GetParameters_Request.h"
#include "rcl_interfaces/srv/GetParameters_Response.h"
#include "rcl_interfaces/srv/ListParameters_Request.h"
#include "rcl_interfaces/srv/ListParameters_Response.h"
#include "rcl_interfaces/srv/SetParametersAtomically_Request.h"
#include "rcl_interfaces/srv/SetParametersAtomically_Response.h"
#include "rcl_interfaces/srv/SetParameters_Request.h"
#include "rcl_interfaces/srv/SetParameters_Response.h"

namespace foretrack {
namespace {

using namespace rcl_interfaces::srv;
using rcl_interfaces::msg::Parameter;
using rcl_interfaces::msg::SetParametersResult;

constexpr std::size_t kMost = 1000;  // of one request; nobody asks for more

SetParametersResult result_of(const std::string& fault) {
  SetParametersResult result;
  result.successful(fault.empty());
  result.reason(fault);
  return result;
}

template <class Request>
std::size_t asked_by(const Request& request) {
  if constexpr (requires { request.names(); })
    return request.names().size();
  else if constexpr (requires { request.parameters(); })
    return request.parameters().size();
  else
    return request.prefixes().size();
}

}  // namespace

template <class Request, class Response>
void ParameterServer::serve(const char* name, const char* type,
                            std::function<void(const Request&, Response&)> answer) {
  const std::string node = node_.options().names.vehicle + '/' + node_.options().service;
  const auto reply_to = [answer](const CdrBytes& bytes) -> CdrBytes {
    Request request;
    if (!from_cdr(type_ops<Request>(), bytes, &request) || asked_by(request) > kMost) return {};
    Response response;
    answer(request, response);
    return to_cdr(type_ops<Response>(), &response);
  };
  servers_.push_back(std::make_unique<RosServer>(
      node_, RosServiceInfo{node + '/' + name, std::string("rcl_interfaces::srv::dds_::") + type},
      reply_to));
}

ParameterServer::ParameterServer(Node& node, Parameters& parameters)
    : node_(node), parameters_(parameters), events_(node) {
  serve_reading();
  serve_setting();
}

void ParameterServer::serve_reading() {
  serve<ListParameters_Request, ListParameters_Response>(
      "list_parameters", "ListParameters", [this](const auto& request, auto& response) {
        response.result(parameters_.list(request.prefixes(), request.depth()));
      });
  serve<GetParameters_Request, GetParameters_Response>(
      "get_parameters", "GetParameters", [this](const auto& request, auto& response) {
        for (const auto& name : request.names()) response.values().push_back(parameters_.get(name));
      });
  serve<GetParameterTypes_Request, GetParameterTypes_Response>(
      "get_parameter_types", "GetParameterTypes", [this](const auto& request, auto& response) {
        for (const auto& name : request.names())
          response.types().push_back(parameters_.get(name).type());
      });
  serve<DescribeParameters_Request, DescribeParameters_Response>(
      "describe_parameters", "DescribeParameters", [this](const auto& request, auto& response) {
        for (const auto& name : request.names())
          response.descriptors().push_back(parameters_.describe(name));
      });
}

void ParameterServer::serve_setting() {
  serve<SetParameters_Request, SetParameters_Response>(
      "set_parameters", "SetParameters", [this](const auto& request, auto& response) {
        std::vector<Parameter> changed;
        for (const auto& wanted : request.parameters()) {
          response.results().push_back(result_of(parameters_.set(wanted)));
          if (response.results().back().successful()) changed.push_back(wanted);
        }
        tell(changed);
      });
  serve<SetParametersAtomically_Request, SetParametersAtomically_Response>(
      "set_parameters_atomically", "SetParametersAtomically",
      [this](const auto& request, auto& response) {
        std::string fault;
        for (const auto& wanted : request.parameters())
          if (fault.empty()) fault = parameters_.fault_of(wanted);
        response.result(result_of(fault));
        if (!fault.empty()) return;
        for (const auto& wanted : request.parameters()) parameters_.set(wanted);
        tell(request.parameters());
      });
}

void ParameterServer::tell(const std::vector<Parameter>& changed) {
  if (changed.empty()) return;
  auto& event = events_.sample();
  event.stamp(node_.clock().now());
  event.node('/' + node_.options().names.vehicle + '/' + node_.options().service);
  event.changed_parameters(changed);
  for (auto& parameter : event.changed_parameters()) {
    parameter.value(parameters_.get(parameter.name()));
    spdlog::info("{}: {} was set by a tool", node_.options().service, parameter.name());
  }
  events_.write();
}

}  // namespace foretrack
