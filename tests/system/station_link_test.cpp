// SPDX-License-Identifier: Apache-2.0
// The ground station where the way to it is the trouble: others on the network, lost packets.
#include "services/launch/domain.hpp"
#include "tests/system/station_program.hpp"

namespace foretrack {
namespace {

// ── TLS ──

class StationOnTheNetwork : public ::testing::Test {
 protected:
  std::string file(const char* name) const { return (folder_.path / name).string(); }
  bool make_certificate() {
    Program openssl(
        {"openssl", "req", "-x509", "-newkey", "ec", "-pkeyopt", "ec_paramgen_curve:P-256",
         "-nodes", "-days", "2", "-subj", "/CN=station", "-addext", "subjectAltName=IP:127.0.0.1",
         "-keyout", file("key.pem"), "-out", file("certificate.pem")},
        folder_.path / "openssl.out", "/usr/bin/env");
    return openssl.wait(20.0) == 0;
  }
  const FreeDomain domain_;
  Folder folder_;
};

TEST_F(StationOnTheNetwork, WantsTlsAndTheTokenOnAnAddressThatOthersReach) {
  Program bare({"station", "--address", "0.0.0.0", "--port", "0", "--domain",
                std::to_string(domain_.id()), "--token-file", file("tokens")},
               folder_.path / "bare.out");
  EXPECT_GT(bare.wait(20.0), 0);
  EXPECT_NE(bare.output().find("--certificate and --key"), std::string::npos) << bare.output();

  if (!has_npm_packages()) GTEST_SKIP() << "npm ci was not run in " << kWeb;
  if (!make_certificate()) GTEST_SKIP() << "no openssl program";
  Station station({"station", "--address", "0.0.0.0", "--domain", std::to_string(domain_.id()),
                   "--certificate", file("certificate.pem"), "--key", file("key.pem")},
                  folder_.path);
  const Json r = probe("tls.mjs", {"127.0.0.1:" + std::to_string(station.port()),
                                   file("certificate.pem"), station.token()});
  EXPECT_EQ(r["trusted"], 200) << r;
  EXPECT_EQ(r["without_token"], 401) << r;
  EXPECT_EQ(r["wrong_token"], 401) << r;
  EXPECT_EQ(r["page"], 200) << "the page itself is public: it asks for the token";
  EXPECT_EQ(r["wss"], "serverInfo") << r;
  EXPECT_EQ(r["wss_without_token"], 401) << r;
  for (const auto* refused :
       {"untrusted", "old_tls", "in_the_clear", "wss_untrusted", "ws_in_the_clear"})
    EXPECT_TRUE(r[refused].is_string()) << refused << ": " << r[refused];
}

// ── a link that loses packets ──

/// The network device of lossy_link.py; it goes with its owner.
class LossyLink {
 public:
  LossyLink(const std::filesystem::path& folder, const std::string& loss,
            const std::string& bytes_s)
      : program_({"python3", FORETRACK_SOURCE_DIR "/tests/system/lossy_link.py", "foretrack-loss",
                  here(), there(), loss, "0.05", bytes_s},
                 folder / "link.out", "/usr/bin/env") {}
  static std::string here() { return "198.18.77.1"; }  // of the range for measurements
  static std::string there() { return "198.18.77.2"; }
  bool ready() {
    eventually([this] { return !program_.running() || is_up(); }, 10.0);
    return program_.running() && is_up();
  }

 private:
  bool is_up() const { return program_.output().find("ready") != std::string::npos; }
  Program program_;
};

int free_port() {
  const int fd = socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  socklen_t size = sizeof address;
  bind(fd, reinterpret_cast<sockaddr*>(&address), size);
  getsockname(fd, reinterpret_cast<sockaddr*>(&address), &size);
  close(fd);
  return ntohs(address.sin_port);
}

/// Ages over the bad link, and at the same time on this machine.
struct Ages {
  Json far, near;
};

class StationOverALossyLink : public ::testing::Test {
 protected:
  std::string domain() const { return std::to_string(domain_.id()); }
  Ages measure(const std::string& loss, const std::string& bytes_s) {
    LossyLink link(folder_.path, loss, bytes_s);
    if (!link.ready()) return {};
    const int port = free_port();
    const auto end = ":" + std::to_string(port);
    Station station({"station", "--domain", domain(), "--address", "0.0.0.0", "--insecure-lan",
                     "--allow-host", LossyLink::there() + end},
                    folder_.path, port);
    eventually([&] { return !station.vehicle().is_null(); }, 60.0);
    const auto url = [&](const std::string& host) { return "ws://" + host + end + "/ws"; };
    std::thread near([&, this] {
      near_ = probe("ages.mjs", {url("127.0.0.1"), "15", station.token()});
    });
    auto far = probe("ages.mjs", {url(LossyLink::there()), "15", station.token()});
    near.join();
    return {far, near_};
  }

  const FreeDomain domain_;
  Folder folder_;
  Json near_;
  Program flight_{{"up", "--scenario", "t_intersection", "--domain", domain(), "--out",
                   (folder_.path / "up").string()},
                  folder_.path / "up.out"};
};

// 20 % of the packets are lost each way, 50 ms each way, 1 Mbit/s: less than what the page reads.
TEST_F(StationOverALossyLink, ThePageStaysLiveAndOthersSeeNoDelay) {
  if (!has_npm_packages()) GTEST_SKIP() << "npm ci was not run in " << kWeb;
  const auto [far, near] = measure("0.2", "125000");
  if (far.is_null())
    GTEST_SKIP() << "no network device could be made: not root, or no /dev/net/tun";
  EXPECT_EQ(far["closed"], "") << "a slow link is no reason to close";
  for (const auto* topic : {"/uav1/odometry", "/uav1/target/state", "/uav1/safety/state",
                            "/uav1/plan/trajectory", "/station/status"}) {
    ASSERT_TRUE(far["topics"].contains(topic)) << topic << far;
    EXPECT_GE(far["topics"][topic]["count"], 5) << topic;
    EXPECT_LT(far["topics"][topic]["p50_ms"], 5000) << topic << ": newest wins";
  }
  const auto& all = near["all"];
  EXPECT_GT(all["count"].get<int>(), 3 * far["all"]["count"].get<int>());
  EXPECT_LT(all["p50_ms"], far["all"]["p50_ms"]) << near;
  EXPECT_LT(all["longest_gap_ms"], far["all"]["longest_gap_ms"]) << near;
}

}  // namespace
}  // namespace foretrack
