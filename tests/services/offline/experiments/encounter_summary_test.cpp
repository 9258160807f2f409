// SPDX-License-Identifier: Apache-2.0
#include "services/offline/experiments/encounter_summary.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace foretrack {
namespace {

EncounterRecord met(int person, double speed_m_s, double gap_m) {
  EncounterRecord e{.person = person};
  e.person_speed_m_s = speed_m_s;
  e.least_gap_m = gap_m;
  e.seen = true;
  return e;
}

struct Flights {
  std::vector<FlightJob> jobs;
  std::vector<RunRecord> records;

  void add(EncounterKind kind, EncounterPlace place, double speed_m_s,
           std::vector<EncounterRecord> encounters) {
    FlightJob& job = jobs.emplace_back();
    job.cell = {"encounters/" + std::string(to_string(kind)), "intention", MapSource::kKnown,
                speed_m_s};
    job.overrides.seed = jobs.size();
    job.command = "foretrack fly";
    RunRecord& record = records.emplace_back();
    record.staged = Encounter{kind, place};
    record.encounters = std::move(encounters);
  }
};

TEST(EncounterSummary, PoolsByKindAndByPlace) {
  Flights f;
  f.add(EncounterKind::kHeadOn, EncounterPlace::kCorridor, 1.5,
        {met(0, 1.5, 0.6), met(1, 1.5, 0.4), met(1, 1.5, -0.1)});
  f.add(EncounterKind::kHeadOn, EncounterPlace::kOpen, 1.5, {met(2, 1.0, 0.8)});
  f.add(EncounterKind::kGroup, EncounterPlace::kOpen, 1.5, {met(1, 3.0, 0.1)});
  f.records[1].encounters[0].longest_loss_s = 0.7;
  f.records[2].longest_hover_s = 2.5;
  const EncounterSummary s = summarize_encounters(f.jobs, f.records);
  ASSERT_EQ(s.by_kind.size(), 2u);
  const EncounterCell& head_on = s.by_kind[0];
  EXPECT_EQ(head_on.name, "head_on");
  EXPECT_EQ(head_on.flights, 2);
  EXPECT_EQ(head_on.encounters, 4);
  EXPECT_EQ(head_on.person_encounters, 1);
  EXPECT_EQ(head_on.contacts(), 1);
  EXPECT_EQ(head_on.bystander_contacts, 1);
  EXPECT_EQ(head_on.floor_judged, 4);
  EXPECT_EQ(head_on.floor_kept, 2);
  EXPECT_EQ(head_on.view_kept, 3);
  EXPECT_EQ(head_on.gap_min_m, -0.1);
  EXPECT_EQ(head_on.gap_p50_m, 0.4);
  EXPECT_EQ(head_on.contact_95.low, wilson(1, 4).low);
  EXPECT_EQ(s.by_kind[1].floor_judged, 0) << "faster than any floor";
  EXPECT_EQ(s.by_kind[1].hovering_flights, 1);
  ASSERT_EQ(s.by_place.size(), 2u);
  EXPECT_EQ(s.by_place[0].name, "corridor");
  EXPECT_EQ(s.by_place[1].encounters, 2);
}

TEST(EncounterSummary, AContactWithSomebodyUnseenIsToldApart) {
  Flights f;
  f.add(EncounterKind::kTowards, EncounterPlace::kOpen, 2.0,
        {met(1, 2.0, -0.2), met(1, 2.0, -0.1)});
  f.records[0].encounters[1].seen = false;
  const EncounterCell cell = summarize_encounters(f.jobs, f.records).by_kind.at(0);
  EXPECT_EQ(cell.contacts(), 2);
  EXPECT_EQ(cell.unseen_contacts, 1);
}

TEST(EncounterSummary, IsWrittenWithALineForEachEncounter) {
  Flights f;
  f.add(EncounterKind::kStop, EncounterPlace::kOpen, 1.0, {met(0, 1.0, 0.9), met(1, 1.0, 0.7)});
  const auto json =
      nlohmann::json::parse(encounters_json_of(summarize_encounters(f.jobs, f.records)));
  EXPECT_EQ(json["by_kind"][0]["encounters"], 2);
  EXPECT_EQ(json["by_place"][0]["name"], "open");
  const std::string csv = encounters_csv_of(f.jobs, f.records);
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 3);
  EXPECT_NE(csv.find("stop,open,intention,known,1,1,0,"), std::string::npos);
}

TEST(Encounters, FailWhereAFloorIsBrokenOrAWallIsTouched) {
  EXPECT_TRUE(outcome_of(met(0, 1.5, 0.5)).success);
  EXPECT_FALSE(outcome_of(met(0, 1.5, 0.45)).success);
  EXPECT_TRUE(outcome_of(met(0, 2.0, 0.31)).success);
  EXPECT_TRUE(outcome_of(met(0, 3.0, 0.01)).success);
  EXPECT_FALSE(outcome_of(met(0, 3.0, 0.0)).success);
  EncounterRecord wall = met(0, 1.0, 2.0);
  wall.wall_contact = true;
  EXPECT_FALSE(outcome_of(wall).success);
}

}  // namespace
}  // namespace foretrack
