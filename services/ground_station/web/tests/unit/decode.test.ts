// SPDX-License-Identifier: Apache-2.0
// Bytes as the bus has them, written by the schemas' own writer, read by the page's decoder.
import assert from "node:assert/strict";
import { test } from "node:test";

import { Decoders, idlName } from "../../src/data/decode.ts";
import { Intake } from "../../src/data/intake.ts";
import type { PlannedTrajectory, SafetyState } from "../../src/data/messages.ts";
import { SampleQueue } from "../../src/data/queue.ts";
import type { Channel, RawSample } from "../../src/data/sample.ts";
import { ownerOf, partsOf } from "../../src/data/topics.ts";
import { samplePlan } from "../../src/store/derive.ts";
import { flatIdl } from "../flat_idl.mjs";
import { encode, safety, samplesAt, schemaNameOf, typeOf } from "../synthetic.mjs";

const channelOf = (topic: string, type: string): Channel => ({ topic, encoding: "cdr",
  schemaName: schemaNameOf(type), schemaEncoding: "omgidl", schema: flatIdl(type) });

// A frame of the protocol begins at an odd offset.
function unaligned(bytes: Uint8Array): Uint8Array {
  const buffer = new Uint8Array(bytes.byteLength + 13);
  buffer.set(bytes, 13);
  return buffer.subarray(13);
}

test("every topic that the page reads survives the wire", () => {
  const decoders = new Decoders((problem) => assert.fail(problem));
  const seen = new Set<string>();
  for (const step of [100, 150, 200])
    for (const [name, message] of samplesAt(step / 100, step, 0)) {
      const type = typeOf(name);
      const bytes = unaligned(encode(type, message));
      const decoded = decoders.decode(channelOf(`/a/${name}`, type), bytes);
      assert.ok(decoded, name);
      seen.add(name);
    }
  assert.equal(seen.size, 13);
});

test("a gate's report is read field for field", () => {
  const sent = safety(12.25, { mode: 2, reason: 4, command_id: 7n, operator_id: "ada" });
  const type = "foretrack_msgs/SafetyState";
  const read = new Decoders().decode(channelOf("/a/safety/state", type),
    unaligned(encode(type, sent))) as SafetyState;
  assert.deepEqual([read.mode, read.reason, read.command_id, read.operator_id, read.armed],
    [2, 4, 7n, "ada", true]);
  assert.deepEqual(read.header.stamp, { sec: 12, nanosec: 250000000 });
});

test("a plan's polynomial is read in its order of powers", () => {
  const type = "foretrack_msgs/PlannedTrajectory";
  const [, message] = samplesAt(1, 100, 0).find(([name]) => name === "plan/trajectory")!;
  const coefficients = [[1, 0, 0], [0, 2, 0], [0, 0, 3], ...new Array(3).fill([0, 0, 0])].flat();
  const plan = new Decoders().decode(channelOf("/a/plan/trajectory", type), encode(type,
    { ...(message as object), pieces: [{ duration_s: 2, coefficients }] })) as PlannedTrajectory;
  const points = [[1, 0, 0], [1, 2, 3], [1, 4, 12]];
  assert.deepEqual(samplePlan(plan, 2), points);
  const recorded = { ...plan, pieces: [{ duration_s: 2, coefficients }] }; // as ROS 2 has it
  assert.deepEqual(samplePlan(recorded as PlannedTrajectory, 2), points);
});

test("a schema that cannot be read is reported once, bytes that cannot be read each time", () => {
  const problems: string[] = [];
  const decoders = new Decoders((problem) => problems.push(problem));
  const bad = { ...channelOf("/a/health", "foretrack_msgs/ServiceHealth"), schema: "struct {" };
  assert.equal(decoders.decode(bad, new Uint8Array(8)), undefined);
  assert.equal(decoders.decode(bad, new Uint8Array(8)), undefined);
  assert.equal(problems.length, 1);
  const good = channelOf("/a/health", "foretrack_msgs/ServiceHealth");
  assert.equal(decoders.decode(good, new Uint8Array([0, 1, 0, 0, 9])), undefined);
  assert.equal(problems.length, 2);
});

test("names of types are one in all spellings", () => {
  for (const name of ["foretrack_msgs/msg/TargetState", "foretrack_msgs::msg::TargetState",
    "foretrack_msgs::msg::dds_::TargetState_"])
    assert.equal(idlName(name), "foretrack_msgs::msg::TargetState");
});

test("topics tell their vehicle, and the autopilot's are given to theirs", () => {
  assert.deepEqual(partsOf("/uav1/target/state"), { vehicle: "uav1", name: "target/state" });
  assert.deepEqual(partsOf("rt/uav1/odometry"), { vehicle: "uav1", name: "odometry" });
  assert.deepEqual(partsOf("/tf"), { vehicle: "", name: "tf" });
  assert.equal(ownerOf("px4_2", ["uav1", "uav2"]), "uav2");
  assert.equal(ownerOf("", ["uav1"]), "uav1");
  assert.equal(ownerOf("", ["uav1", "uav2"]), "uav1");
  assert.equal(ownerOf("", ["uav2", "uav3"]), undefined);
});

const raw = (topic: string, time_s: number, data = new Uint8Array(4)): RawSample => ({ time_s,
  channel: { topic, encoding: "json", schemaName: "", schemaEncoding: "", schema: "" },
  bytes: data.byteLength, data });

test("a queue keeps the newest of a state, all of the events, and counts every sample", () => {
  const queue = new SampleQueue();
  for (let i = 0; i < 3; i++) {
    queue.push(raw("/a/odometry", i));
    queue.push(raw("/a/safety/state", i));
  }
  const batch = queue.take();
  assert.equal(batch.length, 6);
  const kept = (topic: string) => batch.filter((s) => s.channel.topic === topic && s.data).length;
  assert.deepEqual([kept("/a/odometry"), kept("/a/safety/state")], [1, 3]);
  assert.equal(queue.take().length, 0);
});

test("a long batch of a recording is thinned to forty samples a second", () => {
  const text = new TextEncoder().encode("{}");
  const channel: Channel = { topic: "/a/odometry", encoding: "json", schemaName: "",
    schemaEncoding: "", schema: "" };
  const batch = Array.from({ length: 1000 }, (_, i) =>
    ({ channel, time_s: i / 100, bytes: 2, data: text }));
  const samples = new Intake(() => {}).take(batch);
  const decoded = samples.filter((s) => s.message !== undefined).length;
  assert.equal(samples.length, 1000);
  assert.ok(decoded > 300 && decoded <= 401, String(decoded));
  assert.ok(samples[999]!.message !== undefined);
});
