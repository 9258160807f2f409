// SPDX-License-Identifier: Apache-2.0
// A recording read back through the same path as live samples.
import assert from "node:assert/strict";
import { test } from "node:test";

import { Intake } from "../../src/data/intake.ts";
import { openMcap, readableOf } from "../../src/data/open_recording.ts";
import { reduce } from "../../src/store/reduce.ts";
import { makeState, type State } from "../../src/store/state.ts";
import { probabilities } from "../synthetic.mjs";
import { syntheticRecording } from "../write_mcap.mjs";

const begin_s = 1_700_000_000;
const file = syntheticRecording({ begin_s, seconds: 6, vehicles: ["uav1", "uav2"] });
const opened = file.then((bytes) => openMcap("test.mcap", readableOf(blobOf(bytes))));
const blobOf = (bytes: Uint8Array): Blob => new Blob([bytes as Uint8Array<ArrayBuffer>]);

async function stateAt(from_s: number, to_s: number): Promise<State> {
  const recording = await opened;
  const state = makeState();
  const intake = new Intake((problem) => assert.fail(problem));
  const samples = [...await recording.lastBefore(from_s),
    ...await recording.read(from_s, to_s, () => false)];
  for (const sample of intake.take(samples)) reduce(state, { kind: "sample", sample });
  return reduce(state, { kind: "time", now_s: to_s });
}

test("a recording tells its span and its topics", async () => {
  const recording = await opened;
  assert.ok(Math.abs(recording.begin_s - begin_s - 0.02) < 1e-5);
  assert.ok(Math.abs(recording.end_s - begin_s - 6) < 1e-5);
  assert.ok(recording.topics().includes("/uav2/plan/trajectory"));
});

test("samples come in the order of log time, each in one of two neighbouring ranges", async () => {
  const recording = await opened;
  const [all, first, second] = [await recording.read(begin_s, begin_s + 4, () => false),
    await recording.read(begin_s, begin_s + 1.5, () => false),
    await recording.read(begin_s + 1.5, begin_s + 4, () => false)];
  assert.equal(first.length + second.length, all.length);
  assert.ok(all.every((s, i) => i === 0 || s.time_s >= all[i - 1]!.time_s));
});

test("the state at a time is that of the samples up to it", async () => {
  const state = await stateAt(begin_s, begin_s + 4.4);
  const { intentions } = state.vehicles.get("uav1")!.latest["target/intention"]!.message;
  const expected = probabilities(4.4);
  for (const i of intentions) assert.ok(Math.abs(i.probability - expected[i.name]!) < 1e-12);
});

test("a map that was sent before the sought place is still there", async () => {
  const state = await stateAt(begin_s + 5.1, begin_s + 5.9);
  assert.ok(Math.abs(state.vehicles.get("uav2")!.latest["map/local"]!.time_s - begin_s - 4) < 1e-5);
});

test("a recording that was cut off is read up to its last chunk", async () => {
  const bytes = await file;
  const cut = await openMcap("cut.mcap", readableOf(blobOf(bytes.subarray(0, bytes.length / 2))));
  const whole = await opened;
  assert.equal(cut.begin_s, whole.begin_s);
  assert.ok(cut.end_s > begin_s + 1.5 && cut.end_s < begin_s + 4.5, String(cut.end_s - begin_s));
  const to_s = cut.end_s - 0.05; // of the last moment some samples are in the lost chunk
  const [a, b] = [await cut.read(begin_s, to_s, () => false),
    await whole.read(begin_s, to_s, () => false)];
  assert.equal(a.length, b.length);
  assert.deepEqual(a[100], b[100]);
  const [c, d] = [await cut.lastBefore(begin_s + 1), await whole.lastBefore(begin_s + 1)];
  assert.equal(c.length, d.length);
});

test("what is not an MCAP file is refused", async () => {
  await assert.rejects(openMcap("x", readableOf(new Blob(["not a recording at all"]))));
});
