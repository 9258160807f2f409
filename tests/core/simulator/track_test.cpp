// SPDX-License-Identifier: Apache-2.0
#include "core/simulator/track.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "tests/support/error_of.hpp"

namespace foretrack {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

std::string error_of(std::string_view text, TrackFormat format = TrackFormat::kFrameIdXy,
                     double rate_hz = 25.0) {
  return foretrack::error_of([&] { parse_tracks(text, format, rate_hz, "walks.txt"); });
}

TEST(ParseTracks, ReadsTimePositionAndPedestrian) {
  const auto tracks = parse_tracks("# a comment\n100 7 1.0 2.0\n110 7 1.5 2.5\r\n\n110 3 9 8\n",
                                   TrackFormat::kFrameIdXy, 25.0, "walks.txt");
  ASSERT_EQ(tracks.size(), 2u);
  EXPECT_EQ(tracks[0].pedestrian, 3);
  EXPECT_NEAR(tracks[0].points[0].time_s, 0.4, 1e-12);
  const auto& seven = track_of(tracks, 7, "walks.txt").points;
  ASSERT_EQ(seven.size(), 2u);
  EXPECT_EQ(seven[1].position_m, Vec2(1.5, 2.5));
  EXPECT_NEAR(seven[1].time_s - seven[0].time_s, 0.4, 1e-12);
}

TEST(ParseTracks, TakesOpenTrajColumnsXAndY) {
  const auto tracks = parse_tracks("1.0e+00 1.0e+00 -2.8 0.0 18.9 0.1 0 -1.3\n",
                                   TrackFormat::kOpenTraj, 25.0, "obsmat.txt");
  EXPECT_EQ(tracks[0].points[0].position_m, Vec2(-2.8, 18.9));
}

TEST(ParseTracks, NamesLineFaultAndExpectedRow) {
  EXPECT_THAT(
      error_of("1 1 0 0\n2 1 x 0\n"),
      AllOf(HasSubstr("walks.txt:2"), HasSubstr("x is not a number"), HasSubstr("frame id x y")));
  EXPECT_THAT(error_of("1 1 0\n"), AllOf(HasSubstr("walks.txt:1"), HasSubstr("3 columns")));
  EXPECT_THAT(error_of("1 1 0 0\n\n1 1 2 2\n"),
              AllOf(HasSubstr("walks.txt:3"), HasSubstr("pedestrian 1 do not increase")));
  EXPECT_THAT(error_of("1.5 1 0 0\n"), HasSubstr("frame 1.500000 is not a whole number"));
  EXPECT_THAT(error_of("1 1 nan 0\n"), HasSubstr("nan is not a number"));
  EXPECT_THAT(error_of("# nothing\n"), HasSubstr("no rows"));
  EXPECT_THAT(error_of("1 1 0 0\n", TrackFormat::kFrameIdXy, -1.0), HasSubstr("rate_hz"));
  EXPECT_THAT(error_of("1 1 0 0\n", TrackFormat::kOpenTraj), HasSubstr("x z y"));
}

TEST(TrackOf, ListsThePedestriansThatExist) {
  const auto tracks =
      parse_tracks("1 4 0 0\n1 7 0 0\n1 8 0 0\n1 9 0 0\n", TrackFormat::kFrameIdXy, 25.0, "w");
  try {
    track_of(tracks, 5, "walks.txt");
    FAIL() << "no error";
  } catch (const std::invalid_argument& error) {
    EXPECT_THAT(error.what(), AllOf(HasSubstr("no pedestrian 5"), HasSubstr("4, 7–9")));
  }
}

// Somebody walks 1.2 m/s along x, at 25 frames a second, in metres times `scale`.
std::string walk(double scale, const char* head = "", const char* format = "%d 1 %.3f 0\n") {
  std::string text = head;
  for (int frame = 0; frame < 60; ++frame) {
    char row[80];
    std::snprintf(row, sizeof row, format, frame, scale * 0.048 * frame);
    text += row;
  }
  return text;
}

std::vector<Track> parse(std::string_view text, double rate_hz = 0.0) {
  return parse_tracks(text, TrackFormat::kFrameIdXy, rate_hz, "walks.csv");
}

TEST(ParseTracks, SkipsAByteOrderMark) {
  EXPECT_EQ(parse(walk(1.0, "\xEF\xBB\xBF")).front().points.size(), 60u);
}

TEST(ParseTracks, TakesColumnsAndRateAsTheFileNamesThem) {
  constexpr const char* kSwapped = "1 %d %.3f 0\n";
  for (const char* head : {"# framerate: 10\n# id frame x y\n", "#framerate: 10\nid,frame,x,y\n"}) {
    const auto tracks = parse(walk(1.0, head, kSwapped));
    ASSERT_EQ(tracks.size(), 1u) << head;
    EXPECT_NEAR(tracks[0].points[1].time_s, 0.1, 1e-12);
    EXPECT_EQ(tracks[0].lines[1], 4);
  }
  const auto with_height = parse(walk(1.0, "# id frame x y z\n", "1 %d %.3f 0 1.5\n"));
  EXPECT_NEAR(with_height[0].points[2].position_m.x(), 0.096, 1e-9);
  EXPECT_NEAR(parse(walk(1.0, "# framerate: 10\n"), 50.0)[0].points[1].time_s, 0.02, 1e-12);
}

TEST(ParseTracks, RefusesWhatNobodyRunsWithItsLikelyCause) {
  std::string crowd = "";  // id frame x y: nine people, one after the other
  for (int id = 1; id < 10; ++id)
    for (int frame = 0; frame < 30; ++frame)
      crowd += std::to_string(id) + " " + std::to_string(frame) + " " +
               std::to_string(2.0 * id + 0.05 * frame) + " 1.5\n";
  EXPECT_THAT(error_of(crowd), HasSubstr("the columns look like 'id frame x y'"));
  EXPECT_THAT(error_of(walk(10.0)),
              AllOf(HasSubstr("12.0 m/s"), HasSubstr("At 2.70 frames a second, instead of 25.0")));
  EXPECT_THAT(error_of(walk(40.0)), AllOf(HasSubstr("48.0 m/s"), HasSubstr("not pixels?")));
  EXPECT_EQ(error_of(walk(4.0)), "no error");  // somebody sprints
}

TEST(TrackOf, NamesTheLineToWhichAPedestrianJumps) {
  const auto tracks = parse(walk(1.0) + "60 1 9.0 0\n61 1 9.05 0\n");
  const auto jump = [&] { track_of(tracks, 1, "walks.csv"); };
  EXPECT_THAT(jump, ::testing::ThrowsMessage<std::invalid_argument>(
                        AllOf(HasSubstr("walks.csv:61: pedestrian 1 jumps 6.16 m"),
                              HasSubstr("nobody is faster than 8.00 m/s"))));
}

TEST(ParseTracks, ReadsTheUcyPedestriansAsSmoothWalks) {
  std::ifstream in("../shared/data/ucy_zara01_obsmat.txt");
  if (!in) GTEST_SKIP() << "../shared/data/ucy_zara01_obsmat.txt is absent";
  std::ostringstream text;
  text << in.rdbuf();
  const auto tracks = parse_tracks(text.str(), TrackFormat::kOpenTraj, 25.0, "zara01");
  EXPECT_GT(tracks.size(), 100u);
  for (const auto& track : tracks) {
    if (track.points.size() < 5) continue;
    const Walk walk = walk_through(track.points);
    for (double t = 0.0; t < walk.duration_s(); t += 0.2)
      ASSERT_LT(walk.at(t).velocity_m_s.norm(), 5.0) << track.pedestrian;
  }
}

}  // namespace
}  // namespace foretrack
