// SPDX-License-Identifier: Apache-2.0
import assert from "node:assert/strict";
import { test } from "node:test";

import { SceneFeed } from "../../src/scene/feed.ts";
import { Known } from "../../src/scene/known.ts";
import { drawnTopics, sketch } from "../../src/scene/sketch.ts";
import { makeState, type State } from "../../src/store/state.ts";
import { fold, odometry, safety, sample, target } from "./make.ts";

const shown = (state: State, generation = 1) =>
  ({ state, generation, vehicle: state.vehicles.get("a") });

/** As it arrives in the scene's thread. */
function tell(feed: SceneFeed, known: Known, state: State, generation = 1): number {
  const news = structuredClone(feed.take(shown(state, generation)));
  known.apply(news);
  return news.vehicles.flatMap((v) => [...Object.keys(v.latest), ...v.trail, ...v.targetTrail]).length;
}

test("the scene comes to know what the page knows, however seldom it asks", () => {
  const state = makeState();
  const feed = new SceneFeed();
  const known = new Known();
  for (let i = 0; i < 400; i++) {
    const jump_m = i > 250 ? 50 : 0; // it was put elsewhere
    fold([sample("/a/odometry", i * 0.1, odometry(jump_m + 0.07 * i, 0)),
      sample("/a/safety/state", i * 0.1, safety(i * 0.1)),
      sample("/b/target/state", i * 0.1, target(0.2 * i, 1))], state);
    if (i % 7 === 0 || i === 399) tell(feed, known, state);
  }
  assert.equal(known.chosen, "a");
  assert.equal(known.now_s, state.now_s);
  for (const [name, { latest, trail, targetTrail }] of state.vehicles) {
    const seen = known.vehicles.get(name)!;
    for (const topic of drawnTopics) {
      const heard = latest[topic];
      assert.deepEqual(seen.latest[topic], heard && sketch(topic, heard, name === "a"));
    }
    assert.deepEqual(seen.trail.points, trail.points);
    assert.deepEqual(seen.targetTrail.points, targetTrail.points);
  }
  assert.ok(known.vehicles.get("a")!.trail.points.length > 50);
});

test("nothing is told twice, and all of it to a new generation", () => {
  const state = fold([sample("/a/odometry", 1, odometry(0, 0)),
    sample("/a/target/state", 1, target(3, 4))]);
  const feed = new SceneFeed();
  const known = new Known();
  assert.equal(tell(feed, known, state), 4);
  assert.equal(tell(feed, known, state), 0);
  fold([sample("/a/target/state", 1.1, target(3, 4))], state);
  assert.equal(tell(feed, known, state), 1);
  assert.equal(tell(feed, known, state, 2), 4);
  tell(feed, known, makeState(), 3);
  assert.equal(known.vehicles.size, 0);
});

test("details of the chosen vehicle alone are told, also when it is chosen later", () => {
  const face = { normal: [0, 0, 1], offset_m: 2 };
  const plan = { header: { stamp: { sec: 0 } }, pieces: [{ duration_s: 2,
    coefficients: [[0, 0, 1], [1, 0, 0], [0, 0, 0], [0, 0, 0], [0, 0, 0], [0, 0, 0]] }],
    tail_start_s: 1.5, stage_times: [], corridor: [{ faces: [face] }], visible_regions: [] };
  const state = fold([sample("/a/odometry", 1, odometry(0, 0)),
    sample("/b/plan/trajectory", 1, plan)]);
  const feed = new SceneFeed();
  const known = new Known();
  const corridor = () => known.vehicles.get("b")!.latest["plan/trajectory"]!.message.corridor;
  tell(feed, known, state);
  assert.deepEqual(corridor(), []);
  known.apply(structuredClone(feed.take({ ...shown(state), vehicle: state.vehicles.get("b") })));
  assert.deepEqual(corridor(), plan.corridor);
  const { points, tail } = known.vehicles.get("b")!.latest["plan/trajectory"]!.message;
  assert.deepEqual([...points.slice(0, 3), ...points.slice(-3), tail], [0, 0, 1, 2, 0, 1, 0.75]);
});
