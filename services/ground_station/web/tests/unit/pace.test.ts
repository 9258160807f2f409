// SPDX-License-Identifier: Apache-2.0
import assert from "node:assert/strict";
import { test } from "node:test";

import { Pace } from "../../src/scene/pace.ts";

let now_ms = 0;

function drawn(pace: Pace, display_hz: number, seconds: number): number {
  let count = 0;
  for (let n = 0; n < display_hz * seconds; n++) {
    if (pace.isDue(now_ms)) count++;
    now_ms += 1000 / display_hz;
  }
  return count / seconds;
}

test("thirty frames a second at any rate of the display", () => {
  for (const display_hz of [60, 75, 90, 144])
    assert.ok(Math.abs(drawn(new Pace(1), display_hz, 20) - 30) < 0.2, `${display_hz} Hz`);
  assert.ok(Math.abs(drawn(new Pace(1), 20, 10) - 20) < 0.2, "a slow display");
});

test("a page that stood still does not make up for it", () => {
  const pace = new Pace(1);
  assert.ok(pace.isDue(0) && pace.isDue(60000));
  assert.ok(pace.isDue(60033) && !pace.isDue(60040));
});

test("coarser where drawing takes too long, at once as far as it takes, down to a half", () => {
  const pace = new Pace(1);
  const busy_ms = (): number => 4 + 36 * pace.ratio ** 2; // 40 at first
  for (let s = 0; s < 6; s++) pace.adapt(busy_ms() < 22 ? 30 : 20, busy_ms());
  assert.ok(pace.ratio > 0.5 && busy_ms() < 22, `${pace.ratio}`);
  for (let s = 0; s < 20; s++) pace.adapt(15, 40);
  assert.equal(pace.ratio, 0.5);
});

test("coarser before frames are missing, and no finer than there is time for", () => {
  const pace = new Pace(1);
  const busy_ms = (): number => 4 + 30 * pace.ratio ** 2;
  for (let s = 0; s < 100; s++) pace.adapt(30, busy_ms());
  assert.ok(pace.ratio < 0.9 && pace.ratio > 0.6 && busy_ms() < 24, `${pace.ratio}`);
});

test("fine again where all is well", () => {
  const pace = new Pace(2);
  for (let s = 0; s < 20; s++) pace.adapt(15, 40);
  for (let s = 0; s < 100; s++) pace.adapt(30, 5);
  assert.equal(pace.ratio, 2);
});

test("a picture that costs little stays fine, whatever holds the page up", () => {
  const pace = new Pace(1);
  for (let s = 0; s < 20; s++) pace.adapt(22, 5);
  assert.equal(pace.ratio, 1);
});

test("what is too fine is tried less and less often", () => {
  const pace = new Pace(1);
  let changes = 0;
  let before = pace.ratio;
  for (let s = 0; s < 300; s++) {
    if (pace.ratio > 0.9) pace.adapt(15, 30);
    else pace.adapt(30, 5);
    if (pace.ratio !== before) changes++;
    before = pace.ratio;
  }
  assert.ok(changes < 25, `${changes}`);
});

test("where even coarse pictures are too much, few; and all again when the machine is free", () => {
  const pace = new Pace(1);
  for (let s = 0; s < 10; s++) pace.adapt(5, 100);
  assert.ok(drawn(pace, 60, 10) < 13);
  for (let s = 0; s < 10; s++) pace.adapt(12, 10);
  assert.ok(drawn(pace, 60, 10) > 29);
});
