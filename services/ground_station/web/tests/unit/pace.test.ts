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

test("coarser where frames are missing, finer again where all is well, down to a half", () => {
  const pace = new Pace(2);
  for (let s = 0; s < 20; s++) pace.adapt(15);
  assert.equal(pace.ratio, 0.5);
  for (let s = 0; s < 100; s++) pace.adapt(30);
  assert.equal(pace.ratio, 2);
});

test("what is too fine is tried less and less often", () => {
  const pace = new Pace(1);
  let changes = 0;
  let before = pace.ratio;
  for (let s = 0; s < 300; s++) {
    pace.adapt(pace.ratio > 0.9 ? 15 : 30);
    if (pace.ratio !== before) changes++;
    before = pace.ratio;
  }
  assert.ok(changes < 20, `${changes}`);
});

test("where even coarse pictures are too much, few; and all again when the machine is free", () => {
  const pace = new Pace(1);
  for (let s = 0; s < 10; s++) pace.adapt(5);
  assert.ok(drawn(pace, 60, 10) < 13);
  for (let s = 0; s < 10; s++) pace.adapt(12);
  assert.ok(drawn(pace, 60, 10) > 29);
});
