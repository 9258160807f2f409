// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "core/common/image.hpp"
#include "services/common/clock.hpp"
#include "services/common/raw.hpp"
#include "services/convert/encode_jpeg.hpp"
#include "services/ground_station/mcap/writer.hpp"
#include "services/ground_station/report/vehicle_teller.hpp"
#include "services/ground_station/report/write_report.hpp"
#include "tests/support/folder.hpp"

namespace foretrack::station {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
namespace msg = foretrack_msgs::msg;

constexpr double kBegin_s = 1'700'000'000.0;  // 2023-11-14 22:13:20 UTC

std::vector<std::uint8_t> picture(int width = 16) {
  std::vector<std::uint8_t> jpeg;
  encode_jpeg({width, 16, std::vector<std::uint8_t>(3ul * width * 16, 80)}, 60, jpeg);
  return jpeg;
}

nav_msgs::msg::Odometry odometry(double x_m, double y_m = 0.0) {
  nav_msgs::msg::Odometry message;
  message.pose().pose().position().x(x_m);
  message.pose().pose().position().y(y_m);
  message.pose().pose().position().z(2.0);
  message.twist().twist().linear().x(1.0);
  return message;
}

msg::TargetState person(double x_m, std::uint8_t status) {
  msg::TargetState message;
  message.status(status);
  message.position_m({x_m, 0.0, 1.2});
  return message;
}

msg::SafetyState gate(std::uint8_t mode, std::uint8_t phase, bool armed = true) {
  msg::SafetyState message;
  message.mode(mode);
  message.phase(phase);
  message.armed(armed);
  return message;
}

std::string texts(const VehicleStory& story) {
  std::string all;
  for (const auto& event : story.events) all += event.text + (event.bad ? " !" : "") + "\n";
  return all;
}

// Walks along x at 1 m/s, 2 m before the vehicle; out of sight from 10 s to 14 s.
VehicleStory walk() {
  VehicleTeller teller("uav1");
  for (int i = 0; i <= 200; ++i) {
    const double t = 0.1 * i, time_s = kBegin_s + t;
    teller.take(time_s, odometry(t));
    const bool hidden = t > 10.0 && t < 14.0;
    teller.take(time_s, person(t + 2.0, !hidden ? 1 : t < 12.0 ? 2 : 3));
    teller.take(time_s, gate(hidden ? 2 : 0, 1));
    sensor_msgs::msg::CompressedImage image;
    const auto jpeg = picture(t > 13.95 ? 32 : t > 10.35 ? 24 : 16);
    image.data().assign(jpeg.begin(), jpeg.end());
    teller.take(time_s, image);
  }
  return teller.finish();
}

TEST(VehicleTeller, WaysTimesAndDistancesAreThoseOfTheFlight) {
  const VehicleStory story = walk();
  EXPECT_NEAR(story.flown_m, 20.0, 0.3);
  EXPECT_NEAR(story.armed_s, 20.0, 0.2);
  EXPECT_NEAR(story.tracked_s, 16.0, 0.3);
  EXPECT_NEAR(story.seen_s, 16.0, 0.3);
  EXPECT_NEAR(story.distance_m.mean(), 2.0, 1e-6);
  EXPECT_NEAR(story.speed_m_s.most, 1.0, 1e-6);
  EXPECT_NEAR(story.track.size(), 70, 15);
}

TEST(VehicleTeller, ALossIsFromWhenThePersonWasSeenLastAndHasThePicturesOfBothEnds) {
  const VehicleStory story = walk();
  ASSERT_EQ(story.losses.size(), 1u);
  const auto& loss = story.losses.front();
  EXPECT_NEAR(loss.from_s - kBegin_s, 10.0, 0.11);
  ASSERT_TRUE(loss.to_s);
  EXPECT_NEAR(*loss.to_s - kBegin_s, 14.0, 0.11);
  EXPECT_NEAR(loss.where->x_m, 12.0, 0.2);
  EXPECT_EQ(loss.picture, picture(16));
  EXPECT_EQ(loss.found, picture(32));
}

TEST(VehicleTeller, WhoIsNotSeenForAMomentIsNotLost) {
  VehicleTeller teller("uav1");
  for (int i = 0; i < 100; ++i) teller.take(kBegin_s + 0.1 * i, person(1.0, i % 20 == 5 ? 2 : 1));
  EXPECT_TRUE(teller.finish().losses.empty());
}

TEST(VehicleTeller, OrdersModesAndAlarmsAreToldOnceEach) {
  VehicleTeller teller("uav1");
  auto message = gate(0, 1);
  for (int i = 0; i < 5; ++i) teller.take(kBegin_s + i, message);
  message.command_id(7);
  message.command(1);  // hold
  message.command_result(5);
  message.operator_id("ada");
  message.alarm("a second writer of plans");
  for (int i = 5; i < 9; ++i) teller.take(kBegin_s + i, message);
  message.mode(3);
  message.reason(14);
  teller.take(kBegin_s + 9, message);
  const std::string told = texts(teller.finish());
  EXPECT_THAT(told, HasSubstr("hold of ada: refused"));
  EXPECT_THAT(told, HasSubstr("a second writer of plans !"));
  EXPECT_THAT(told, HasSubstr("gate: brake, "));
  EXPECT_EQ(std::count(told.begin(), told.end(), '\n'), 6) << told;
}

TEST(VehicleTeller, WhatNoGateSaysIsPassedOver) {
  VehicleTeller teller("uav1");
  auto message = gate(200, 250);
  message.reason(99);
  message.command(255);
  message.command_id(3);
  message.command_result(77);
  message.mission_end(88);
  teller.take(kBegin_s, message);
  auto nowhere = odometry(std::numeric_limits<double>::quiet_NaN());
  teller.take(kBegin_s, nowhere);
  msg::MissionCommand order;
  order.command(200);
  teller.take(kBegin_s, order);
  const VehicleStory story = teller.finish();
  EXPECT_TRUE(story.track.empty());
  EXPECT_EQ(texts(story), "armed\nsomebody orders: an unknown order\n");
}

TEST(Report, IsOnePageThatNeedsNothingElse) {
  FlightStory story{"flight.mcap", "1.2.3", "ground", "", kBegin_s, kBegin_s + 20.0, {walk()}};
  const std::string html = report_html(story);
  EXPECT_THAT(html, HasSubstr("Flight of 2023-11-14"));
  EXPECT_THAT(html, HasSubstr("22:13:20.0 to 22:13:40.0 UTC, 0:20 min"));
  EXPECT_THAT(html, HasSubstr("<dt>flown</dt><dd>20 m</dd>"));
  EXPECT_THAT(html, HasSubstr("Lost 1: 22:13:30"));
  EXPECT_THAT(html, HasSubstr("data:image/jpeg;base64,/9j/"));
  EXPECT_THAT(html, HasSubstr("<polyline class=\"vehicle\""));
  EXPECT_THAT(html, HasSubstr(">lost 1</text>"));
  EXPECT_THAT(html, Not(HasSubstr("http")));
  EXPECT_THAT(html, Not(HasSubstr("<script")));
}

TEST(Report, WhatARecordingSaysIsTextAndNoMarkup) {
  VehicleStory vehicle;
  vehicle.name = "<b>uav1";
  vehicle.events.push_back({kBegin_s, StoryEvent::Kind::kOrder, false, "<script>x</script> & \""});
  const std::string html =
      report_html({"a<.mcap", "", "", "", kBegin_s, kBegin_s, {std::move(vehicle)}});
  EXPECT_THAT(html, Not(HasSubstr("<script")));
  EXPECT_THAT(html, Not(HasSubstr("<b>")));
  EXPECT_THAT(html, HasSubstr("&lt;script&gt;x&lt;/script&gt; &amp; &quot;"));
}

TEST(Report, WithoutPicturesItSaysSo) {
  VehicleStory vehicle;
  vehicle.losses.push_back({kBegin_s, std::nullopt, std::nullopt, {}, {}});
  const std::string html = report_html({"a", "", "", "", kBegin_s, kBegin_s, {vehicle}});
  EXPECT_THAT(html, HasSubstr("no picture was recorded"));
  EXPECT_THAT(html, HasSubstr("not seen again in this recording"));
}

template <class Message>
void write(mcap::Writer& writer, std::uint16_t id, double time_s, const Message& message) {
  writer.write(id, static_cast<std::uint64_t>(time_s * 1e9), to_cdr(type_ops<Message>(), &message));
}

std::uint16_t add(mcap::Writer& writer, const std::string& name, const std::string& type) {
  return writer.add_channel(
      {"/" + name, "cdr", "", "", "", {{"dds_topic", "rt/" + name}, {"dds_type", type}}});
}

TEST(ReadStory, VehiclesAreToldApartAndOtherTypesArePassedOver) {
  const foretrack::testing::Folder folder;
  const auto file = folder.path / "a.mcap";
  std::ofstream out(file, std::ios::binary);
  mcap::Writer writer(
      [&](std::span<const std::uint8_t> piece) {
        out.write(reinterpret_cast<const char*>(piece.data()),
                  static_cast<std::streamsize>(piece.size()));
        return true;
      },
      "test");
  writer.add_metadata("foretrack", {{"version", "9.9"}, {"host", "here"}});
  const std::string type = TypeName<nav_msgs::msg::Odometry>::value;
  const auto first = add(writer, "uav1/odometry", type),
             second = add(writer, "uav2/odometry", type);
  const auto foreign = add(writer, "uav2/target/state", "other::Type");
  for (int i = 0; i <= 100; ++i) {
    write(writer, first, kBegin_s + 0.1 * i, odometry(0.1 * i));
    write(writer, second, kBegin_s + 0.1 * i, odometry(0.0, 0.2 * i));
    write(writer, foreign, kBegin_s + 0.1 * i, person(1.0, 1));
  }
  writer.write(first, static_cast<std::uint64_t>((kBegin_s + 11.0) * 1e9),
               std::vector<std::uint8_t>(3, 1));
  writer.finish();
  out.close();
  const FlightStory story = read_story(file);
  EXPECT_EQ(story.version, "9.9");
  EXPECT_EQ(story.fault, "");
  ASSERT_EQ(story.vehicles.size(), 2u);
  EXPECT_EQ(story.vehicles[1].name, "uav2");
  EXPECT_NEAR(story.vehicles[0].flown_m, 10.0, 0.3);
  EXPECT_NEAR(story.vehicles[1].flown_m, 20.0, 0.3);
  EXPECT_TRUE(story.vehicles[1].person.empty());
}

TEST(ReadStory, WhatIsNoRecordingOrHoldsNothingIsRefusedByName) {
  const foretrack::testing::Folder folder;
  std::ofstream(folder.path / "no.mcap") << "no recording";
  EXPECT_THROW(read_story(folder.path / "no.mcap"), std::runtime_error);
}

}  // namespace
}  // namespace foretrack::station
