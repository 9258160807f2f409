// SPDX-License-Identifier: Apache-2.0
// The secret of a lease stays with its holder: a flight with orders is recorded and watched, and no
// byte of it is found in what others got.
#include <openssl/evp.h>

#include <array>
#include <cstring>
#include <regex>

#include "foretrack_msgs/msg/MissionCommand.h"
#include "services/common/node.hpp"
#include "services/common/reader.hpp"
#include "services/common/topics.hpp"
#include "services/ground_station/mcap/reader.hpp"
#include "services/launch/domain.hpp"
#include "tests/system/station_program.hpp"

namespace foretrack {
namespace {

constexpr std::size_t kKey = 32;
constexpr std::size_t kMuch = 300'000;          // of what a viewer gets, in a few seconds
constexpr std::uint64_t kLargest = 256u << 20;  // of a piece of memory that is looked through

std::string hex(const std::string& bytes, bool upper) {
  std::string text;
  for (const unsigned char byte : bytes) {
    text += (upper ? "0123456789ABCDEF" : "0123456789abcdef")[byte >> 4];
    text += (upper ? "0123456789ABCDEF" : "0123456789abcdef")[byte & 15];
  }
  return text;
}

/// The name of the lease whose secret this is.
std::string lease_of(const std::string& secret) {
  const auto* bytes = reinterpret_cast<const unsigned char*>(secret.data());
  EVP_PKEY* key = EVP_PKEY_new_raw_private_key(EVP_PKEY_ED25519, nullptr, bytes, secret.size());
  std::string open(kKey, '\0');
  std::size_t size = open.size();
  EVP_PKEY_get_raw_public_key(key, reinterpret_cast<unsigned char*>(open.data()), &size);
  EVP_PKEY_free(key);
  return hex(open, false);
}

struct Piece {
  std::uint64_t begin = 0;
  std::string bytes;
};

/// What a process may write to in its memory; empty: we may not look.
std::vector<Piece> memory_of(pid_t pid) {
  const std::string folder = "/proc/" + std::to_string(pid);
  std::istringstream maps(text_of(folder + "/maps"));
  std::ifstream memory(folder + "/mem", std::ios::binary);
  std::vector<Piece> pieces;
  for (std::string line; std::getline(maps, line);) {
    std::uint64_t begin = 0, end = 0;
    if (std::sscanf(line.c_str(), "%lx-%lx rw", &begin, &end) != 2) continue;
    if (line.find(" rw") == std::string::npos || line.find('/') != std::string::npos) continue;
    if (end - begin > kLargest) continue;
    Piece piece{begin, std::string(end - begin, '\0')};
    memory.clear();
    memory.seekg(static_cast<std::streamoff>(begin));
    if (memory.read(piece.bytes.data(), static_cast<std::streamsize>(piece.bytes.size())))
      pieces.push_back(std::move(piece));
  }
  return pieces;
}

std::vector<std::uint64_t> addresses_of(const std::string& text, const std::vector<Piece>& memory) {
  std::vector<std::uint64_t> found;
  for (const auto& [begin, bytes] : memory)
    for (auto at = bytes.find(text); at != std::string::npos; at = bytes.find(text, at + 1))
      found.push_back(begin + at);
  return found;
}

/// The key's secret stands right before its name, of which it holds the address. Empty: not found.
std::string secret_of(const std::string& lease, const std::vector<Piece>& memory) {
  for (const std::uint64_t address : addresses_of(lease, memory)) {
    const std::string word(reinterpret_cast<const char*>(&address), sizeof address);
    for (const auto& [begin, bytes] : memory)
      for (auto at = bytes.find(word); at != std::string::npos; at = bytes.find(word, at + 1))
        if (at >= kKey && lease_of(bytes.substr(at - kKey, kKey)) == lease)
          return bytes.substr(at - kKey, kKey);
  }
  return "";
}

std::string base64(const std::string& bytes) {
  std::string text(4 * (bytes.size() / 3 + 1) + 1, '\0');
  const int size = EVP_EncodeBlock(reinterpret_cast<unsigned char*>(text.data()),
                                   reinterpret_cast<const unsigned char*>(bytes.data()),
                                   static_cast<int>(bytes.size()));
  text.resize(static_cast<std::size_t>(size));
  return text.substr(0, bytes.size() / 3 * 4);  // of what follows in a longer text, the same
}

/// The secret in any of the ways in which bytes are written down.
bool shows(const std::string& text, const std::string& secret) {
  for (const auto& form : {secret, hex(secret, false), hex(secret, true), base64(secret)})
    if (text.find(form) != std::string::npos) return true;
  return false;
}

/// All that a recording holds, one message after the other.
std::string content_of(const std::filesystem::path& folder) {
  std::string content;
  for (const auto& file : std::filesystem::directory_iterator(folder)) {
    station::mcap::Reader reader(file.path());
    while (const auto message = reader.next())
      content.append(reinterpret_cast<const char*>(message->data.data()), message->data.size());
  }
  return content;
}

/// Subscribes to every channel, and keeps what comes.
class Viewer {
 public:
  Viewer(Station& station) : client_(station.port()) {
    client_.send(testing::upgrade(station.port(), "/ws",
                                  "Authorization: Bearer " + station.token() + "\r\n"));
  }
  /// Once the channels were told of, that of orders among them.
  bool subscribe() {
    const auto told = client_.read_until("/mission/command", 60.0);
    Json list = Json::array();
    const std::regex id("\"id\":([0-9]+)");
    for (std::sregex_iterator at(told.begin(), told.end(), id), end; at != end; ++at)
      list.push_back({{"id", list.size() + 1}, {"channelId", std::stoi((*at)[1])}});
    return client_.send(
        testing::frame(0x81, Json({{"op", "subscribe"}, {"subscriptions", list}}).dump()));
  }
  /// All that came, once there is much.
  std::string watch() {
    std::string got;
    eventually([&] { return (got = client_.read_until("\x01never\x01", 0.5)).size() > kMuch; },
               60.0);
    return got;
  }

 private:
  testing::RawClient client_;
};

/// A flight, its recorder and a station that holds the lease.
class Secrecy : public ::testing::Test {
 protected:
  Json post(const std::string& path, Json body) {
    body["vehicle"] = "uav1";
    body["operator"] = "ada";
    return station_.post(path, body);
  }
  bool holds_the_lease() {
    return eventually([&] { return post("/api/lease", {{"action", "take"}})["ok"] == true; }, 60.0);
  }
  /// Once it flies: whoever holds the lease must start it, unless it began before.
  bool is_taken(const std::string& order) {
    const auto command = [this](const std::string& what) {
      return post("/api/command", {{"command", what}})["ok"] == true;
    };
    return eventually(
        [&] {
          if (command(order)) return true;
          command("start");
          return false;
        },
        60.0);
  }
  /// The lease under which the last order came, as everybody hears it.
  std::string lease() {
    reader_.take_each([this](const auto& order) {
      if (order.lease_id().size() > 0) lease_ = order.lease_id().c_str();
    });
    return lease_;
  }
  std::string secret() {
    std::string found;
    eventually(
        [&] {
          if (!lease().empty()) found = secret_of(lease(), memory_of(station_.program().pid()));
          return !found.empty();
        },
        20.0);
    return found;
  }

  const FreeDomain domain_;
  const std::string id_ = std::to_string(domain_.id());
  Folder folder_;
  Program flight_{{"up", "--scenario", "t_intersection", "--domain", id_, "--out",
                   (folder_.path / "up").string()},
                  folder_.path / "up.out"};
  Program recorder_{{"record", "--domain", id_, "--recordings", (folder_.path / "seen").string()},
                    folder_.path / "record.out"};
  Station station_{{"station", "--domain", id_, "--enable-control"}, folder_.path};
  Node node_{{.service = "listener",
              .names = {},
              .domain_id = domain_.id(),
              .ros_distro = {},
              .interface = {},
              .security = {},
              .peers = {},
              .discovery_server = {}}};
  Reader<topics::MissionCommand> reader_{node_};
  std::string lease_;
};

TEST_F(Secrecy, NoTopicNoViewerAndNoRecordingShowsTheSecretOfALease) {
  ASSERT_TRUE(holds_the_lease()) << station_.program().output();
  Viewer viewer(station_);
  ASSERT_TRUE(viewer.subscribe());
  const std::string secret = this->secret();
  if (secret.empty() && memory_of(station_.program().pid()).empty())
    GTEST_SKIP() << "the memory of another process may not be read";
  ASSERT_EQ(lease_of(secret), lease()) << "the test knows what it looks for";
  for (const auto* order : {"hold", "resume", "stop"}) EXPECT_TRUE(is_taken(order)) << order;
  EXPECT_EQ(post("/api/lease", {{"action", "release"}})["ok"], true);
  const std::string watched = viewer.watch();
  recorder_.send(SIGINT);
  ASSERT_EQ(recorder_.wait(20.0), 0) << recorder_.output();

  const std::string recorded = content_of(folder_.path / "seen");
  EXPECT_NE(recorded.find(lease()), std::string::npos) << "the orders are in the recording";
  EXPECT_NE(watched.find("mission/command"), std::string::npos) << "and a viewer hears of them";
  EXPECT_GT(watched.size(), kMuch);
  EXPECT_FALSE(shows(recorded, secret));
  EXPECT_FALSE(shows(watched, secret));
  for (const auto* file : {"audit", "station.out", "up.out", "record.out", "tokens"})
    EXPECT_FALSE(shows(text_of(folder_.path / file), secret)) << file;
}

}  // namespace
}  // namespace foretrack
