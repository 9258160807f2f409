// SPDX-License-Identifier: Apache-2.0
// The server against clients that do not mean well, and one that does.
#include "services/ground_station/http/server.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <thread>

#include "services/ground_station/http/files.hpp"
#include "tests/services/ground_station/raw_client.hpp"
#include "tests/support/folder.hpp"

namespace foretrack::station {
namespace {

using testing::frame;
using testing::RawClient;
using testing::request;
using testing::upgrade;

class Web : public ::testing::Test {
 protected:
  Web() {
    options_.port = 0;
    options_.request_limit_s = 0.5;
    options_.connections = 20;
    options_.clients = 3;
  }
  void SetUp() override {
    server_ = std::make_unique<Server>(options_, hub_);
    const auto host = "127.0.0.1:" + std::to_string(server_->port());
    server_->set_guard({{host}, {"http://" + host}, false});
    server_->set_admission(
        [](const Request& r) { return r.query == "token=wrong" ? "a valid token expected" : ""; });
    server_->set_handler([](const Request& r, const Respond& respond) {
      respond(text_response(200, "body " + r.body + " path " + r.path));
    });
    server_->every(0.1, [this] { hub_.check(steady_s()); });
    Channel channel;
    channel.id = 1;
    channel.topic = "/t";
    hub_.open(channel);
    thread_ = std::thread([this] { server_->run(); });
  }
  void TearDown() override {
    server_->stop();
    thread_.join();
    server_.reset();
  }
  unsigned short port() const { return server_->port(); }
  std::string answer(const std::string& bytes, const std::string& until = "\r\n\r\n") {
    RawClient client(port());
    client.send(bytes);
    return client.read_until(until);
  }
  // Whoever misbehaves, the next one is served.
  bool serves() {
    return answer(request("GET /x", port()), "path /x").find("200 OK") != std::string::npos;
  }

  ServerOptions options_;
  Hub hub_{"station", "1", {}};
  std::unique_ptr<Server> server_;
  std::thread thread_;
};

TEST_F(Web, AnswersARequestWithHeadersThatKeepBrowsersCareful) {
  const auto text = answer(request("POST /x%20y?q=1", port(), "", "hello"), "path");
  EXPECT_NE(text.find("body hello path /x y"), std::string::npos) << text;
  EXPECT_NE(text.find("Content-Security-Policy: default-src 'self'"), std::string::npos);
  EXPECT_NE(text.find("X-Content-Type-Options: nosniff"), std::string::npos);
  EXPECT_NE(text.find("frame-ancestors 'none'"), std::string::npos);
}

TEST_F(Web, RefusesANameThatIsNotItsOwn) {
  for (const auto* host : {"evil.example", "127.0.0.1", "127.0.0.1:1", "evil.example:8080", ""})
    EXPECT_NE(answer(std::string("GET / HTTP/1.1\r\nHost: ") + host + "\r\n\r\n").find("421"),
              std::string::npos)
        << host;
}

TEST_F(Web, RefusesPagesOfAnotherOriginForRequestsAndForWebSockets) {
  for (const auto* origin : {"http://evil.example", "null", "https://127.0.0.1:1"}) {
    const auto line = std::string("Origin: ") + origin + "\r\n";
    EXPECT_NE(answer(request("POST /api/command", port(), line, "{}")).find("403"),
              std::string::npos);
    EXPECT_NE(answer(upgrade(port(), "/ws", line)).find("403"), std::string::npos);
  }
  const auto own = "Origin: http://127.0.0.1:" + std::to_string(port()) + "\r\n";
  EXPECT_NE(answer(upgrade(port(), "/ws", own)).find("101"), std::string::npos);
}

TEST_F(Web, OpensAWebSocketForAdmittedClientsOfTheProtocolOnly) {
  const auto opened = answer(upgrade(port()), "advertise");
  EXPECT_NE(opened.find("101"), std::string::npos);
  EXPECT_NE(opened.find("foxglove.websocket.v1"), std::string::npos);
  EXPECT_NE(opened.find("serverInfo"), std::string::npos);
  EXPECT_NE(answer(upgrade(port(), "/ws?token=wrong")).find("401"), std::string::npos);
  EXPECT_NE(answer(upgrade(port(), "/elsewhere")).find("404"), std::string::npos);
  auto other = upgrade(port());
  other.replace(other.find("foxglove.websocket.v1"), 21, "mqtt.websocket.protoc");
  EXPECT_NE(answer(other).find("400"), std::string::npos);
}

TEST_F(Web, CutsOffWhoSendsARequestByteByByte) {
  RawClient slow(port());
  const auto begin = std::chrono::steady_clock::now();
  bool sent = true;
  for (const char c : request("GET /", port()) + std::string(200, 'x')) {
    sent = sent && slow.send(std::string(1, c));
    if (slow.is_closed(0.02)) break;
  }
  EXPECT_TRUE(slow.is_closed());
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(10));
  EXPECT_TRUE(serves());
}

TEST_F(Web, CutsOffWhoSaysNothing) {
  RawClient silent(port());
  EXPECT_TRUE(silent.is_closed());
}

TEST_F(Web, RefusesWhatIsTooLargeOrNoRequestAtAll) {
  const auto many = "X-Fill: " + std::string(20'000, 'a') + "\r\n";
  EXPECT_NE(answer(request("GET /", port(), many)).find("413"), std::string::npos);
  const auto body = "Content-Length: 99999999\r\n";
  EXPECT_NE(answer(request("POST /", port(), body)).find("413"), std::string::npos);
  for (const auto* bytes :
       {"\x16\x03\x01\x02\x00\x01", "NONSENSE\r\n\r\n", "GET / HTTP/9.9\r\n\r\n",
        "GET / HTTP/1.1\r\nContent-Length: -5\r\n\r\n"}) {
    RawClient client(port());
    client.send(std::string(bytes) + "\r\n\r\n");
    EXPECT_TRUE(client.is_closed()) << bytes;
  }
  EXPECT_TRUE(serves());
}

TEST_F(Web, ClosesAWebSocketForOversizedAndMalformedFrames) {
  const std::string frames[] = {
      frame(0x81, std::string(200'000, ' ')),  // larger than allowed
      std::string("\x81\x05hello"),            // not masked
      frame(0xF1, "reserved bits"),            //
      frame(0x83, "no such op code"),          //
      frame(0x81, "\xff\xfe\xfd"),             // text that is not UTF-8
      std::string("\x81\xff\xff\xff\xff\xff\xff\xff\xff\xff\1\2\3\4", 14),  // 2⁶⁴ bytes announced
      frame(0x89, std::string(126, 'p')),  // a ping that is too long
  };
  for (const auto& bad : frames) {
    RawClient client(port());
    client.send(upgrade(port()));
    ASSERT_NE(client.read_until("advertise").find("101"), std::string::npos);
    client.send(bad);
    EXPECT_TRUE(client.is_closed());
  }
  EXPECT_TRUE(serves());
}

TEST_F(Web, AnswersNonsenseInAWebSocketWithAStatusAndGoesOn) {
  RawClient client(port());
  client.send(upgrade(port()));
  client.read_until("advertise");
  client.send(frame(0x81, "{\"op\": 7}") + frame(0x82, "\x01binary"));
  EXPECT_NE(client.read_until("does not offer").find("\"status\""), std::string::npos);
}

TEST_F(Web, ClosesAWebSocketThatFloods) {
  RawClient client(port());
  client.send(upgrade(port()));
  client.read_until("advertise");
  std::string flood;
  for (int i = 0; i < 2000; ++i) flood += frame(0x81, "{}");
  client.send(flood);
  EXPECT_NE(client.read_until("too many messages").find("too many messages"), std::string::npos);
  EXPECT_TRUE(client.is_closed());
}

TEST_F(Web, HasRoomForSoManyClientsAndNoMore) {
  std::vector<std::unique_ptr<RawClient>> clients;
  for (int i = 0; i < 3; ++i) {
    clients.push_back(std::make_unique<RawClient>(port()));
    clients.back()->send(upgrade(port()));
    ASSERT_NE(clients.back()->read_until("advertise").find("101"), std::string::npos);
  }
  EXPECT_NE(answer(upgrade(port())).find("503"), std::string::npos);
  clients.clear();
  bool again = false;
  for (int i = 0; i < 100 && !again; ++i)
    again = answer(upgrade(port())).find("101") != std::string::npos;
  EXPECT_TRUE(again);
}

TEST_F(Web, AClientThatNeverReadsDelaysNobody) {
  RawClient deaf(port()), reader(port());
  const auto subscribe =
      frame(0x81, R"({"op": "subscribe", "subscriptions": [{"id": 0, "channelId": 1}]})");
  for (auto* client : {&deaf, &reader}) {
    client->send(upgrade(port()));
    client->read_until("advertise");
    client->send(subscribe);
  }
  ASSERT_TRUE(serves());  // so that both subscriptions were heard
  std::atomic<int> delivered = 0;
  for (int i = 0; i < 100; ++i)
    server_->post([&, i] {
      const auto text = i == 99 ? "the last" : std::string(300'000, 'x');
      hub_.deliver({{1, now_ns(), std::make_shared<const Bytes>(text.begin(), text.end())}},
                   steady_s());
      ++delivered;
    });
  EXPECT_NE(reader.read_until("the last").find("the last"), std::string::npos);
  EXPECT_EQ(delivered, 100);
  EXPECT_TRUE(serves());
}

TEST(Files, ServesWhatIsInTheFolderAndNothingElse) {
  const testing::Folder folder;
  std::filesystem::create_directories(folder.path / "page" / "assets");
  std::ofstream(folder.path / "page" / "index.html") << "<p>";
  std::ofstream(folder.path / "page" / "assets" / "a.js") << "0123456789";
  std::ofstream(folder.path / "secret") << "secret";
  std::filesystem::create_symlink(folder.path / "secret", folder.path / "page" / "link");
  const auto page = folder.path / "page";
  EXPECT_EQ(serve_file(page, "/", "", false).type, "text/html; charset=utf-8");
  EXPECT_EQ(serve_file(page, "/assets/a.js", "", false).file->end, 10u);
  for (const auto* path : {"/../secret", "/assets/../../secret", "/link", "/assets", "/none", "//"})
    EXPECT_EQ(serve_file(page, path, "", false).status, 404) << path;
  EXPECT_EQ(serve_file({}, "/", "", false).status, 404);
}

TEST(Files, ServesTheRangeThatIsAskedFor) {
  const testing::Folder folder;
  std::ofstream(folder.path / "a.mcap") << "0123456789";
  const auto range = [&](const char* text) {
    return serve_file(folder.path, "/a.mcap", text, false);
  };
  const auto part = [&](const char* text) {
    const auto response = range(text);
    return response.status == 206 ? std::pair{response.file->begin, response.file->end}
                                  : std::pair{std::uint64_t{99}, std::uint64_t{99}};
  };
  EXPECT_EQ(part("bytes=0-3"), (std::pair<std::uint64_t, std::uint64_t>{0, 4}));
  EXPECT_EQ(part("bytes=4-"), (std::pair<std::uint64_t, std::uint64_t>{4, 10}));
  EXPECT_EQ(part("bytes=-3"), (std::pair<std::uint64_t, std::uint64_t>{7, 10}));
  EXPECT_EQ(part("bytes=8-99"), (std::pair<std::uint64_t, std::uint64_t>{8, 10}));
  for (const auto* bad : {"bytes=10-", "bytes=5-2", "bytes=a-b", "lines=1-2", "bytes=1", "bytes=-"})
    EXPECT_EQ(range(bad).status, 416) << bad;
}

}  // namespace
}  // namespace foretrack::station
