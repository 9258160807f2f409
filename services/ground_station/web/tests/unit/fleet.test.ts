// SPDX-License-Identifier: Apache-2.0
// What a vehicle says of its fleet becomes events, alarms and a sentence.
import assert from "node:assert/strict";
import { test } from "node:test";

import type { FleetDivision } from "../../src/data/messages.ts";
import { partsOf } from "../../src/data/topics.ts";
import { sketch } from "../../src/scene/sketch.ts";
import { fold, sample } from "./make.ts";

const peer = (vehicle: string, more: object = {}) =>
  ({ vehicle, trust: 1, age_s: 0.1, position_m: [0, 0, 1], separation_m: 2, ...more });
const division = (peers: object[]) =>
  ({ header: { stamp: { sec: 0, nanosec: 0 }, frame_id: "map" }, vehicle: "uav1", is_alone: false, seat: 15,
    is_near: false, bearing_rad: 1.57, distance_m: 3.5, seats: [], intentions: [], union_visibility: 0.9,
    separation_m: 2, peers });
const told = (time_s: number, peers: object[]) =>
  sample("/uav1/fleet/division", time_s, division(peers));

test("who comes and who is heard no more is told once", () => {
  const state = fold([told(1, [peer("uav2")]), told(1.1, [peer("uav2"), peer("uav3")]),
    told(1.2, [peer("uav3")]), told(1.3, [peer("uav3")])]);
  assert.deepEqual(state.events.map((e) => e.text).filter((text) => text !== "first heard of"),
    ["uav2 flies along", "uav3 flies along", "uav2 is heard no more"]);
});

test("a vehicle that sees the person elsewhere is an alarm until it agrees", () => {
  const state = fold([told(1, [peer("uav2", { trust: 4 })])]);
  const alarm = [...state.alarms.values()].find((a) => a.text.includes("uav2"));
  assert.equal(alarm?.cleared_s, null);
  fold([told(2, [peer("uav2")])], state);
  assert.notEqual([...state.alarms.values()].find((a) => a.text.includes("uav2"))?.cleared_s, null);
});

test("what all vehicles tell is of no vehicle", () => {
  assert.deepEqual(partsOf("/fleet/member"), { vehicle: "", name: "fleet/member" });
});

test("seats are drawn towards where they are, and only those that are held", () => {
  const seat = (vehicle: string, number: number, is_near: boolean) => ({ vehicle, seat: number, is_near, sees: [] });
  const message = { ...division([]), seats: [seat("uav1", 3, true), seat("uav2", 18, false), seat("uav3", -1, false)] };
  const { message: seats } = sketch("fleet/division", { time_s: 1, message: message as FleetDivision }, true);
  assert.deepEqual(seats.map((s) => [s.vehicle, s.near]), [["uav1", true], ["uav2", false]]);
  assert.ok(Math.abs(seats[0]!.bearing_rad - Math.PI / 2) < 1e-9);
  assert.ok(Math.abs(seats[1]!.bearing_rad - Math.PI) < 1e-9);
});
