// SPDX-License-Identifier: Apache-2.0
// A client as rmw_fastrtps has it asks a service. tests/interop asks as rmw_cyclonedds does.
#include "services/common/parameter_server.hpp"

#include <gmock/gmock.h>

#include <thread>

#include "rcl_interfaces/srv/GetParameters_Request.h"
#include "rcl_interfaces/srv/GetParameters_Response.h"
#include "rcl_interfaces/srv/ListParameters_Request.h"
#include "rcl_interfaces/srv/ListParameters_Response.h"
#include "rcl_interfaces/srv/SetParameters_Request.h"
#include "rcl_interfaces/srv/SetParameters_Response.h"
#include "services/common/service.hpp"
#include "services/common/type_hash.hpp"
#include "tests/services/common/bus.hpp"

namespace foretrack {
namespace {

namespace dds = eprosima::fastdds::dds;
using namespace rcl_interfaces::srv;
using testing::eventually;
using testing::RawPeer;
using testing::RawType;

/// A service that runs, with one parameter that may change and one that may not.
struct Running {
  Running() {
    service.parameters().add("stage", rows, Change::kInFlight);
    service.parameters().add("fixed", rows, Change::kAtStart);
    thread = std::thread([this] { service.run(); });
  }
  ~Running() {
    stop.request();
    thread.join();
  }
  static ServiceOptions options() {
    ServiceOptions options;
    options.domain_id = testing::domain_id();
    return options;
  }
  double rate_hz = 10.0;
  ParamRows rows = {{"rate_hz", &rate_hz, "Hz", 1.0, 30.0, "how often"}};
  Stop stop;
  Service service{"tested", options(), stop};
  std::thread thread;
};

template <class Request, class Response>
class Client {
 public:
  Client(const std::string& name, const std::string& type)
      : asks_("rq/uav1/tested/" + name + "Request",
              "rcl_interfaces::srv::dds_::" + type + "_Request_"),
        hears_("rr/uav1/tested/" + name + "Reply",
               "rcl_interfaces::srv::dds_::" + type + "_Response_") {
    dds::DataReaderQos qos;
    qos.reliability().kind = dds::RELIABLE_RELIABILITY_QOS;
    qos.endpoint().history_memory_policy =
        eprosima::fastrtps::rtps::PREALLOCATED_WITH_REALLOC_MEMORY_MODE;
    reader_ = hears_.add_reader(qos);
    writer_ = asks_.add_writer();
  }

  /// None: no reply to this very request came.
  std::optional<Response> ask(const Request& request) {
    if (!eventually([&] { return testing::readers_of(writer_) == 1; })) return std::nullopt;
    auto bytes = to_cdr(type_ops<Request>(), &request);
    eprosima::fastrtps::rtps::WriteParams params;
    params.related_sample_identity().writer_guid(reader_->guid());
    writer_->write(&bytes, params);
    const auto number = params.sample_identity().sequence_number();
    RawType::Bytes reply;
    dds::SampleInfo info;
    const bool came = eventually([&] {
      return reader_->take_next_sample(&reply, &info) ==
                 eprosima::fastrtps::types::ReturnCode_t::RETCODE_OK &&
             info.related_sample_identity.writer_guid() == reader_->guid() &&
             info.related_sample_identity.sequence_number() == number;
    });
    Response response;
    if (!came || !from_cdr(type_ops<Response>(), reply, &response)) return std::nullopt;
    return response;
  }

 private:
  RawPeer asks_, hears_;
  dds::DataWriter* writer_ = nullptr;
  dds::DataReader* reader_ = nullptr;
};

TEST(ParameterServer, ListsParametersForAClientOfRmwFastrtps) {
  Running running;
  Client<ListParameters_Request, ListParameters_Response> client("list_parameters",
                                                                 "ListParameters");
  const auto reply = client.ask({});
  ASSERT_TRUE(reply);
  EXPECT_THAT(reply->result().names(), ::testing::ElementsAre("debug_log", "fixed.rate_hz",
                                                              "stage.rate_hz", "use_sim_time"));
}

TEST(ParameterServer, AnswersEveryRequestOfOneClient) {
  Running running;
  Client<GetParameters_Request, GetParameters_Response> client("get_parameters", "GetParameters");
  for (int i = 0; i < 5; ++i) {
    GetParameters_Request request;
    request.names({"stage.rate_hz", "nope"});
    const auto reply = client.ask(request);
    ASSERT_TRUE(reply) << i;
    ASSERT_EQ(reply->values().size(), 2u);
    EXPECT_EQ(reply->values()[0].double_value(), 10.0);
    EXPECT_EQ(reply->values()[1].type(), 0);
  }
}

TEST(ParameterServer, SetsWhatMayChangeInFlightAndRefusesTheRestWithAReason) {
  Running running;
  Client<SetParameters_Request, SetParameters_Response> client("set_parameters", "SetParameters");
  SetParameters_Request request;
  for (const char* name : {"stage.rate_hz", "fixed.rate_hz"}) {
    request.parameters().emplace_back();
    request.parameters().back().name(name);
    request.parameters().back().value().type(3);
    request.parameters().back().value().double_value(20.0);
  }
  const auto reply = client.ask(request);
  ASSERT_TRUE(reply);
  ASSERT_EQ(reply->results().size(), 2u);
  EXPECT_TRUE(reply->results()[0].successful());
  EXPECT_FALSE(reply->results()[1].successful());
  EXPECT_NE(reply->results()[1].reason().find("--params"), std::string::npos);
}

TEST(ParameterServer, LivesOnAfterBytesThatAreNoRequest) {
  Running running;
  RawPeer bad("rq/uav1/tested/list_parametersRequest",
              "rcl_interfaces::srv::dds_::ListParameters_Request_");
  auto* writer = bad.add_writer();
  ASSERT_TRUE(eventually([&] { return testing::readers_of(writer) == 1; }));
  for (RawType::Bytes bytes :
       {RawType::Bytes{0, 1, 0, 0}, RawType::Bytes{0, 1, 0, 0, 255, 255, 255, 255}})
    writer->write(&bytes);
  Client<ListParameters_Request, ListParameters_Response> client("list_parameters",
                                                                 "ListParameters");
  EXPECT_TRUE(client.ask({}));
}

TEST(Endpoints, TellTheHashOfTheirType) {
  Running running;
  auto options = testing::node_options("looker");
  const Node looker(options);
  EXPECT_TRUE(eventually([&] {
    for (const auto& e : looker.endpoints())
      if (e.topic == "rt/uav1/health" && e.writes) return e.other_version.empty();
    return false;
  }));
}

TEST(Endpoints, OfAnotherVersionOfOurTypeAreNamed) {
  auto options = testing::node_options("looker");
  const Node looker(options);
  RawPeer peer("rt/uav1/target/state", "foretrack_msgs::msg::dds_::TargetState_");
  peer.add_writer(dds::RELIABLE_RELIABILITY_QOS, "typehash=RIHS01_00;foretrack=9.9.9;");
  std::string named;
  EXPECT_TRUE(eventually([&] {
    for (const auto& e : looker.endpoints()) named = e.other_version;
    return !named.empty();
  }));
  EXPECT_NE(named.find("foretrack 9.9.9"), std::string::npos) << named;
}

TEST(Rosout, HasTheLinesOfAService) {
  set_up_logging("info");
  Node listener(testing::node_options("listener"));
  Reader<topics::Rosout> lines(listener);
  Running running;
  std::string all;
  EXPECT_TRUE(eventually([&] {
    lines.take_each([&](const auto& line) { all += line.name() + ' ' + line.msg() + '\n'; });
    return all.find("uav1.tested runs for uav1") != std::string::npos;
  })) << all;
}

}  // namespace
}  // namespace foretrack
