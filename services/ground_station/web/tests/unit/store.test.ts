// SPDX-License-Identifier: Apache-2.0
import assert from "node:assert/strict";
import { test } from "node:test";

import { acknowledge } from "../../src/store/alarms.ts";
import type { Alarm, State } from "../../src/store/state.ts";
import { grey } from "../../src/ui/palette.ts";
import { fold, health, odometry, safety, sample, target } from "./make.ts";

const alarm = (state: State, key: string): Alarm | undefined => state.alarms.get(key);
const texts = (state: State): string[] => state.events.map((e) => e.text);

test("a vehicle appears with its first sample, under the name that its topics bear", () => {
  const state = fold([sample("/uav1/odometry", 10, odometry(0, 0)),
    sample("/uav2/odometry", 10.1, odometry(5, 0))]);
  assert.deepEqual([...state.vehicles.keys()], ["uav1", "uav2"]);
  assert.deepEqual(state.events.map((e) => [e.vehicle, e.text]),
    [["uav1", "first heard of"], ["uav2", "first heard of"]]);
});

test("distance, yaw error and speeds are those of the poses", () => {
  const state = fold([sample("/a/target/state", 1, target(3, 4)),
    sample("/a/odometry", 1.1, odometry(0, 0, Math.PI / 2, 1.5))]);
  const vehicle = state.vehicles.get("a")!;
  assert.ok(Math.abs(vehicle.distance.newest()! - 5) < 1e-9);
  const expected = (Math.atan2(4, 3) - Math.PI / 2) * 180 / Math.PI;
  assert.ok(Math.abs(vehicle.yawError.newest()! - expected) < 1e-9);
  assert.equal(vehicle.speed.newest(0), 1.5);
  assert.ok(Math.abs(vehicle.speed.newest(1)! - 1) < 1e-9);
});

test("the person's distance is not known before they were ever seen", () => {
  const state = fold([sample("/a/target/state", 1, target(3, 4, 0)),
    sample("/a/odometry", 1.1, odometry(0, 0))]);
  assert.equal(state.vehicles.get("a")!.distance.newest(), null);
});

test("latency is from the image's stamp to the first setpoint that follows from it, once", () => {
  const cause = { caused_by: { sec: 100, nanosec: 0 } };
  const state = fold([sample("/a/safety/state", 0.9, safety(99.9, { caused_by: { sec: 60 } })),
    sample("/a/safety/state", 1, safety(100.1, cause)),
    sample("/a/safety/state", 1.05, safety(100.15, cause)),
    sample("/a/safety/state", 1.1, safety(100.2, { setpoint_valid: false }))]);
  const { latency } = state.vehicles.get("a")!;
  assert.equal(latency.times.length, 1);
  assert.ok(Math.abs(latency.newest()! - 100) < 1e-6);
});

test("the ladder keeps one rung for each stretch of mode and reason", () => {
  const modes = [[0, 0], [0, 0], [1, 2], [2, 2], [2, 2], [0, 0]];
  const state = fold(modes.map(([mode, reason], i) =>
    sample("/a/safety/state", i * 0.1, safety(i * 0.1, { mode, reason }))));
  const rungs = state.vehicles.get("a")!.lanes.gate;
  assert.deepEqual(rungs.map((r) => [r.word, r.why]), [["track", ""],
    ["coast", "plans have ceased to come"], ["hover", "plans have ceased to come"], ["track", ""]]);
  assert.ok(Math.abs(rungs[2]!.from_s - 0.3) < 1e-9 && Math.abs(rungs[2]!.to_s - 0.5) < 1e-9);
});

test("a silent gate makes a gap in the ladder, not a long rung", () => {
  const state = fold([sample("/a/safety/state", 0, safety(0)),
    sample("/a/safety/state", 10, safety(10))]);
  assert.deepEqual(state.vehicles.get("a")!.lanes.gate.map((r) => [r.from_s, r.to_s]),
    [[0, 0], [10, 10]]);
});

test("braking without an order is an alarm, and one that was ordered is a warning", () => {
  const brake = (reason: number): string =>
    alarm(fold([sample("/a/safety/state", 1, safety(1, { mode: 3, reason }))]), "a gate")!.severity;
  assert.equal(brake(5), "alarm");
  assert.equal(brake(9), "warning");
});

test("an alarm stays until it is both over and acknowledged", () => {
  const state = fold([sample("/a/safety/state", 1, safety(1, { mode: 3, reason: 5 }))]);
  fold([sample("/a/safety/state", 1.1, safety(1.1))], state);
  assert.equal(alarm(state, "a gate")!.cleared_s, 1.1);
  acknowledge(state, "a gate");
  assert.equal(alarm(state, "a gate"), undefined);
  fold([sample("/a/safety/state", 1.2, safety(1.2, { mode: 3, reason: 5 }))], state);
  acknowledge(state, "all");
  assert.equal(alarm(state, "a gate")!.acknowledged, true);
  fold([sample("/a/safety/state", 1.3, safety(1.3))], state);
  assert.equal(alarm(state, "a gate"), undefined);
});

test("an acknowledged alarm that grows worse asks again", () => {
  const state = fold([sample("/a/safety/state", 1, safety(1, { mode: 1, reason: 2 }))]);
  acknowledge(state, "all");
  fold([sample("/a/safety/state", 1.1, safety(1.1, { mode: 3, reason: 5 }))], state);
  assert.equal(alarm(state, "a gate")!.acknowledged, false);
});

test("a killed service is silent after some seconds, and its vehicle is not", () => {
  const state = fold([sample("/a/health", 10, health("planning")),
    sample("/a/health", 14, health("mapping")), { kind: "time", now_s: 14.2 }]);
  assert.match(alarm(state, "a service silent planning")!.text, /planning: silent for 4 s/);
  assert.equal(alarm(state, "a service silent mapping"), undefined);
  assert.equal(alarm(state, "a silent"), undefined);
});

test("a lost link is one alarm a vehicle, not one a service", () => {
  const state = fold([sample("/a/health", 10, health("planning")),
    sample("/a/safety/state", 10, safety(10)), { kind: "time", now_s: 14 },
    { kind: "time", now_s: 20 }]);
  assert.deepEqual([...state.alarms.keys()], ["a silent"]);
  assert.match(alarm(state, "a silent")!.text, /10 s/);
});

test("what changes in the gate's report is an event", () => {
  const state = fold([sample("/a/safety/state", 1, safety(1)),
    sample("/a/safety/state", 1.1, safety(1.1, { phase: 5, command_id: 7n, command_result: 1,
      operator_id: "ada", mode: 3, reason: 9 })),
    sample("/a/safety/state", 1.2, safety(1.2, { phase: 5, command_id: 8n, command_result: 4,
      operator_id: "bob", mode: 3, reason: 9 }))]);
  const said = texts(state);
  assert.ok(said.includes("mission: stopped"));
  assert.ok(said.includes("command of ada: accepted"));
  assert.ok(said.includes("command of bob: refused: not from this phase"));
});

test("why a mission ended is told, and a second writer is an alarm while it lasts", () => {
  const second = "a second writer of rt/a/plan/trajectory";
  const state = fold([sample("/a/safety/state", 1, safety(1)),
    sample("/a/safety/state", 1.1, safety(1.1, { phase: 0, mission_end: 1, mode: 4, reason: 9 })),
    sample("/a/safety/state", 1.2, safety(1.2, { alarm: second }))]);
  assert.ok(texts(state).includes("mission over: the pilot took over"));
  assert.equal(alarm(state, "a gate"), undefined);
  assert.equal(alarm(state, "a second writer")!.text, second);
});

test("an order that is being written down is not refused", () => {
  const state = fold([10, 1, 11].map((command_result, i) =>
    sample("/a/safety/state", i, safety(i, { command_id: 7n, command_result, command: 5 }))));
  assert.deepEqual(texts(state).filter((text) => /refused|written down/.test(text)), []);
});

test("who has control is told once, however often the lease is renewed", () => {
  const state = fold(["", "ada", "ada", "ada", "bob", ""].map((lease_operator, i) =>
    sample("/a/safety/state", i, safety(i, { lease_operator, command: 6, command_id: BigInt(i),
      command_result: 1, operator_id: lease_operator }))));
  assert.deepEqual(texts(state).filter((text) => /control|accepted/.test(text)),
    ["ada has control", "bob has control", "bob gave up control"]);
});

test("rates are those of all samples, also of those that were not decoded", () => {
  const state = fold(Array.from({ length: 101 }, (_, i) =>
    sample("/a/odometry", i / 25, i % 2 ? undefined : odometry(0, 0), 500)));
  fold([{ kind: "time", now_s: 4 }], state);
  const traffic = state.traffic.get("/a/odometry")!;
  assert.ok(Math.abs(traffic.rate_hz - 25.25) < 0.3);
  assert.ok(Math.abs(traffic.bytes_s - 12625) < 200);
});

test("the station's report raises mismatches and tells of refused orders", () => {
  const status = (id: number, qos_mismatch: number) => ({
    server: { version: "1", uptime_s: 1, clients: 1, control_enabled: true, needs_token: false },
    vehicles: [{ name: "a", seen_s_ago: 0, lease: null, last_command: { id, command: "hold",
      operator: "ada", result: "refused", reason: "bob has control" } }],
    recording: null, clients: [], topics: [{ topic: "/a/odometry", type: "T", vehicle: "a",
      writers: 1, readers: 1, rate_hz: 1, bytes_s: 1, age_s: 0, limited: false, qos_mismatch,
      foreign_type: null }] });
  const state = fold([status(1, 0), status(2, 1), status(2, 0)].map((message, i) => {
    const input = sample("/x/y", i, message);
    if (input.kind === "sample")
      Object.assign(input.sample, { vehicle: "", name: "station/status" });
    return input;
  }));
  assert.equal(texts(state).filter((t) => t === "hold of ada: refused: bob has control").length, 1);
  assert.equal(alarm(state, "a qos /a/odometry")!.cleared_s, 2);
});

test("warnings of the bus and refused orders are alarms while they hold", () => {
  const status = (warnings: string[], orders_refused: string | null) => ({
    server: { version: "1", uptime_s: 1, clients: 1, control_enabled: true, needs_token: false },
    vehicles: [{ name: "a", seen_s_ago: 0, lease: null, last_command: null, orders_refused }],
    recording: null, clients: [], topics: [], warnings });
  const unsecured = "DDS reaches other machines and is not secured";
  const state = fold([status([unsecured, "3 messages were refused"], null),
    status([unsecured, "12 messages were refused"], "may not order a"), status([], null)]
    .map((message, i) => {
      const input = sample("/x/y", i, message);
      if (input.kind === "sample")
        Object.assign(input.sample, { vehicle: "", name: "station/status" });
      return input;
    }));
  assert.equal(alarm(state, ` bus ${unsecured}`)!.severity, "alarm");
  assert.equal(alarm(state, ` bus ${unsecured}`)!.cleared_s, 2);
  assert.equal(alarm(state, " bus  messages were refused")!.text, "12 messages were refused");
  assert.equal(alarm(state, "a orders refused")!.since_s, 1);
  assert.equal(alarm(state, "a orders refused")!.cleared_s, 2);
});

test("the same inputs give the same state", () => {
  const inputs = Array.from({ length: 200 }, (_, i) => [
    sample("/a/odometry", i / 10, odometry(i * 0.1, 0)),
    sample("/a/target/state", i / 10, target(i * 0.1 + 2, 0, i % 40 === 0 ? 3 : 1)),
    sample("/a/safety/state", i / 10, safety(i / 10, { mode: i % 30 === 0 ? 1 : 0 })),
    { kind: "time" as const, now_s: i / 10 }]).flat();
  assert.deepEqual(fold(inputs), fold(inputs));
});

test("intentions bear the names and colours of their messages, however many there are", () => {
  const said = (t: number, rows: [string, number, number | undefined][]) =>
    sample("/a/target/intention", t, { intentions: rows.map(([name, probability, color_rgb]) =>
      ({ name, probability, color_rgb })) });
  const state = fold([said(1, [["forward", 0.9, 0x56b4e9], ["sit_down", 0.1, 0x00ff0a]]),
    said(2, [["sit_down", 0.7, 0x00ff0a], ["old", 0.3, undefined]])]);
  const vehicle = state.vehicles.get("a")!;
  assert.deepEqual(vehicle.intention.names, ["forward", "sit_down", "old"]);
  assert.equal(vehicle.intention.newest(1), 0.7);
  assert.equal(vehicle.intentionColors.get("sit_down"), "#00ff0a");
  assert.equal(vehicle.intentionColors.get("old"), grey);
});

test("a vehicle of which an old map comes first is not silent", () => {
  const state = fold([{ kind: "time", now_s: 100 }, sample("/uav1/map/local", 60, {}),
    { kind: "time", now_s: 100.1 }]);
  assert.equal(state.alarms.size, 0);
  fold([sample("/uav1/odometry", 100.2, odometry(0, 0)), { kind: "time", now_s: 101 }], state);
  assert.equal(state.alarms.size, 0);
  fold([{ kind: "time", now_s: 103 }], state);
  assert.ok(state.alarms.has("uav1 silent"));
});
