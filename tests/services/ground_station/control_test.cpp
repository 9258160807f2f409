// SPDX-License-Identifier: Apache-2.0
// Tokens, the audit log, and requests to the API without a vehicle.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <mutex>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>
#include <utility>
#include <vector>

#include "services/ground_station/api/api.hpp"
#include "tests/support/folder.hpp"

namespace foretrack::station {
namespace {

using Json = nlohmann::json;
using testing::Folder;

std::string text_of(const std::filesystem::path& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

TEST(Tokens, MakesAFileThatItsOwnerAloneMayRead) {
  const Folder folder;
  const auto path = folder.path / "config" / "tokens";
  const auto tokens = Tokens::load_or_create(path);
  struct stat info {};
  ASSERT_EQ(stat(path.c_str(), &info), 0);
  EXPECT_EQ(info.st_mode & 0777, 0600u);
  EXPECT_EQ(tokens.first().size(), 64u);  // 256 bits
  EXPECT_EQ(Tokens::load_or_create(path).first(), tokens.first());
  EXPECT_TRUE(tokens.may_act_as(tokens.first(), "anybody"));
  chmod(path.c_str(), 0644);
  EXPECT_THROW(Tokens::load_or_create(path), std::runtime_error);
}

TEST(Tokens, KnowsEachOperatorByHerOwn) {
  const Folder folder;
  const auto path = folder.path / "tokens";
  const std::string ada(40, 'a'), bob(40, 'b');
  std::ofstream(path) << "# operators\nada " << ada << "\nbob " << bob << '\n';
  chmod(path.c_str(), 0600);
  const auto tokens = Tokens::load_or_create(path);
  EXPECT_EQ(tokens.owner(ada), "ada");
  EXPECT_TRUE(tokens.may_act_as(bob, "bob"));
  EXPECT_FALSE(tokens.may_act_as(bob, "ada"));
  EXPECT_FALSE(tokens.owner(""));
  EXPECT_FALSE(tokens.owner(std::string(40, 'c')));
  EXPECT_FALSE(tokens.owner(ada.substr(1)));
  std::ofstream(path) << "ada short\n";
  EXPECT_THROW(Tokens::load_or_create(path), std::runtime_error);
}

struct Desk {
  explicit Desk(bool token_to_read = false)
      : api(
            {true, token_to_read, folder.path / "recordings"}, tokens, audit, nullptr, recorder,
            [] { return std::string(R"({"server": {}})"); },
            [this](std::function<void()> work) {
              const std::lock_guard lock(mutex);
              posted.push_back(std::move(work));
            }) {}

  Response ask(const std::string& method, const std::string& path, const std::string& body = {},
               const std::string& token = {}) {
    Request request;
    request.method = method;
    request.path = path;
    request.body = body;
    request.remote = "test";
    if (!token.empty()) request.authorization = "Bearer " + token;
    Response response;
    response.status = 0;
    if (!api.handle(
            request, [&](Response r) { response = std::move(r); }, now_s))
      response.status = -1;
    return response;
  }
  /// The answer to what is made in another thread.
  Response ask_and_wait(const std::string& path, const std::string& query = {}) {
    Request request;
    request.query = query;
    request.method = "GET";
    request.path = path;
    std::optional<Response> response;
    api.handle(
        request, [&](Response r) { response = std::move(r); }, now_s);
    while (!response) {
      const std::lock_guard lock(mutex);
      for (const auto& work : std::exchange(posted, {})) work();
    }
    return *response;
  }
  RecorderOptions options() const {
    RecorderOptions o;
    o.folder = folder.path / "recordings";
    return o;
  }

  Folder folder;
  Tokens tokens = Tokens::load_or_create(folder.path / "tokens");
  Audit audit{folder.path / "audit"};
  Recorder recorder{options()};
  double now_s = 100.0;
  std::mutex mutex;
  std::vector<std::function<void()>> posted;  // to the server's thread
  Api api;
};

TEST(Api, TellsWhatARecordingHoldsAndNothingFromElsewhere) {
  Desk desk;
  const auto recordings = desk.options().folder;
  std::filesystem::create_directories(recordings);
  std::ofstream(recordings / "torn.mcap") << "no recording";
  std::ofstream(desk.folder.path / "secret.mcap") << "not to be read";
  EXPECT_EQ(desk.ask_and_wait("/reports/torn.html").status, 422);
  EXPECT_EQ(desk.ask_and_wait("/reports/none.html").status, 404);
  EXPECT_EQ(desk.ask_and_wait("/reports/../secret.html").status, 404);
  EXPECT_EQ(desk.ask_and_wait("/reports/.html").status, 404);
  EXPECT_EQ(Desk(true).ask("GET", "/reports/torn.html").status, 401);
  EXPECT_EQ(desk.ask_and_wait("/clips/torn.webm").status, 422);
  EXPECT_EQ(desk.ask_and_wait("/clips/none.webm").status, 404);
  EXPECT_EQ(desk.ask_and_wait("/clips/../secret.webm").status, 404);
  EXPECT_EQ(Desk(true).ask("GET", "/clips/torn.webm").status, 401);
  // With a good recording.
  EXPECT_EQ(desk.recorder.start(), "");
  Channel channel;
  channel.id = 1;
  channel.topic = "/a";
  channel.encoding = "json";
  desk.recorder.open(channel);
  desk.recorder.samples({{1, 1'700'000'000'000'000'000, std::make_shared<const Bytes>(Bytes{1})}});
  const std::string file = desk.recorder.status()->file;
  desk.recorder.stop();
  const Response page = desk.ask_and_wait("/reports/" + file.substr(0, file.size() - 5) + ".html");
  EXPECT_EQ(page.status, 200);
  EXPECT_EQ(page.type, "text/html; charset=utf-8");
  EXPECT_NE(page.body.find("No vehicle is in this recording."), std::string::npos);
  const std::string clip = "/clips/" + file.substr(0, file.size() - 5) + ".webm";
  EXPECT_EQ(desk.ask_and_wait(clip).body, "there are no pictures in it\n");
  EXPECT_EQ(desk.ask_and_wait(clip, "from_s=now").body,
            "'from_s' is 'now': seconds from the recording's beginning expected\n");
}

TEST(Api, OrdersNeedAValidToken) {
  Desk desk;
  const std::string body = R"({"vehicle": "uav1", "operator": "ada", "command": "hold"})";
  EXPECT_EQ(desk.ask("POST", "/api/command", body).status, 401);
  EXPECT_EQ(desk.ask("POST", "/api/command", body, std::string(64, '0')).status, 401);
  // Known, but this station has no bus to send it on.
  EXPECT_EQ(desk.ask("POST", "/api/command", body, desk.tokens.first()).status, 403);
  EXPECT_EQ(desk.ask("DELETE", "/api/command", body, desk.tokens.first()).status, 405);
  EXPECT_EQ(desk.ask("POST", "/api/else", body, desk.tokens.first()).status, 404);
  EXPECT_EQ(desk.ask("POST", "/api/command", "[", desk.tokens.first()).status, 400);
  EXPECT_EQ(desk.ask("GET", "/index.html").status, -1);
  const auto log = text_of(desk.folder.path / "audit");
  EXPECT_NE(log.find("a valid token expected"), std::string::npos);
  EXPECT_EQ(log.find(desk.tokens.first()), std::string::npos) << "the log holds the token";
}

TEST(Api, ReadingNeedsATokenWhereOthersCanReachTheStation) {
  Desk open, closed(true);
  EXPECT_EQ(open.ask("GET", "/api/status").status, 200);
  EXPECT_EQ(closed.ask("GET", "/api/status").status, 401);
  EXPECT_EQ(closed.ask("GET", "/recordings/a.mcap").status, 401);
  EXPECT_EQ(closed.ask("GET", "/api/status", "", closed.tokens.first()).status, 200);
}

TEST(Api, WrongTokensAreCountedAndHoldUpNobodyElse) {
  Desk desk;
  int refused = 0;
  for (int i = 0; i < 100; ++i)
    refused += desk.ask("POST", "/api/record", "{}", "guess").status == 429;
  EXPECT_GT(refused, 70);
  const std::string start = R"({"action": "start"})";
  EXPECT_EQ(desk.ask("POST", "/api/record", start, desk.tokens.first()).status, 200);
}

TEST(Api, RecordsAndServesWhatItRecorded) {
  Desk desk;
  const auto token = desk.tokens.first();
  EXPECT_EQ(desk.ask("POST", "/api/record", R"({"action": "start"})", token).status, 200);
  EXPECT_EQ(desk.ask("POST", "/api/record", R"({"action": "start"})", token).status, 409);
  EXPECT_EQ(desk.ask("POST", "/api/record", R"({"action": "stop"})", token).status, 200);
  desk.recorder.stop();
  const auto list = Json::parse(desk.ask("GET", "/api/recordings").body);
  ASSERT_EQ(list.size(), 1u);
  const auto file = "/recordings/" + list[0]["file"].get<std::string>();
  EXPECT_EQ(desk.ask("GET", file).status, 200);
  EXPECT_EQ(desk.ask("GET", "/recordings/../tokens").status, 404);
  EXPECT_EQ(desk.ask("GET", "/recordings/../audit.mcap").status, 404);
}

}  // namespace
}  // namespace foretrack::station
