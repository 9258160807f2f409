// SPDX-License-Identifier: Apache-2.0
// The vehicle's pictures over a network that loses packets, as the station gets them.
#include <cstring>

#include "services/convert/encode_h264.hpp"
#include "services/ground_station/mcap/reader.hpp"
#include "services/launch/domain.hpp"
#include "tests/system/two_hosts.hpp"

namespace foretrack {
namespace {

constexpr int kStation = kGate;  // the host
constexpr double kRecord_s = 14.0, kSettle_s = 3.0;

/// Of one topic: once the readers have been found, how many a second, and how old.
class Arrivals {
 public:
  void add(double time_s, double stamp_s) {
    if (first_s_ == 0.0) first_s_ = time_s;
    if (time_s < first_s_ + kSettle_s) return;
    ages_s_.push_back(time_s - stamp_s);
    last_s_ = time_s;
  }
  double rate_hz() const {
    const double span_s = last_s_ - first_s_ - kSettle_s;
    return span_s > 0.0 ? static_cast<double>(ages_s_.size()) / span_s : 0.0;
  }
  double age_s(double share) const {
    auto sorted = ages_s_;
    std::sort(sorted.begin(), sorted.end());
    return sorted.empty()
               ? 0.0
               : sorted[static_cast<std::size_t>(share * static_cast<double>(sorted.size() - 1))];
  }
  friend std::ostream& operator<<(std::ostream& out, const Arrivals& a) {
    return out << a.rate_hz() << " a second, " << 1e3 * a.age_s(0.5)
               << " ms old at the median, P95 " << 1e3 * a.age_s(0.95);
  }

 private:
  double first_s_ = 0.0, last_s_ = 0.0;
  std::vector<double> ages_s_;
};

class PictureLink : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!network_.is_ready()) GTEST_SKIP() << "no network namespaces: not root, or no /dev/net/tun";
  }
  std::unique_ptr<Program> run(int host, const char* program, std::vector<std::string> words) {
    const auto out = folder_.path / (words.empty() ? "sender" : words[0]);
    words.insert(words.end(), {"--domain", std::to_string(domain_.id()), "--interface",
                               host == kVehicle ? kAddressOfVehicle : kAddressOfGate});
    return std::make_unique<Program>(network_.on(host, std::move(words), program), out,
                                     "/usr/bin/env");
  }
  /// What comes to the station while it reads both topics, by their names.
  std::map<std::string, Arrivals> send() {
    const auto recordings = folder_.path / "recordings";
    const auto sender = run(kVehicle, PICTURE_SENDER, {});
    auto recorder = run(kStation, FORETRACK_PROGRAM,
                        {"record", "--recordings", recordings.string(), "--topics", "ground/"});
    std::this_thread::sleep_for(Seconds(kRecord_s));
    recorder.reset();
    for (const auto& file : std::filesystem::directory_iterator(recordings))
      return arrivals_in(file.path());
    return {};
  }

  const FreeDomain domain_;
  Folder folder_;
  TwoHostsNetwork network_{folder_.path, {"--mtu", "1500"}};

 private:
  static std::map<std::string, Arrivals> arrivals_in(const std::filesystem::path& file) {
    std::map<std::string, Arrivals> all;
    station::mcap::Reader reader(file);
    while (const auto message = reader.next()) {
      const double time_s = 1e-9 * static_cast<double>(message->log_time_ns);
      all[reader.channels().at(message->channel).topic].add(time_s, stamp_s(message->data));
    }
    return all;
  }
  // Both messages begin with their stamp.
  static double stamp_s(std::span<const std::uint8_t> cdr) {
    std::uint32_t at[2] = {};
    if (cdr.size() >= 12) std::memcpy(at, cdr.data() + 4, sizeof at);
    return at[0] + 1e-9 * at[1];
  }
};

// Packets of 1500 bytes: a picture is a dozen.
TEST_F(PictureLink, TenPicturesASecondArriveWhereATwentiethOfThePacketsIsLost) {
  network_.lose("0.05");
  auto came = send();
  const auto& image = came["/uav1/camera/ground/image/compressed"];
  const auto& video = came["/uav1/camera/ground/video"];
  std::cout << "images " << image << ", video " << video << '\n';
  EXPECT_GE(image.rate_hz(), 10.0);
  EXPECT_GE(video.rate_hz(), has_video_encoder() ? 10.0 : 0.0);
}

}  // namespace
}  // namespace foretrack
