// SPDX-License-Identifier: Apache-2.0
import assert from "node:assert/strict";
import { test } from "node:test";

import { hasEnded, makeClock, parseTime, play, seek, setSpeed, step, timeAt,
} from "../../src/data/clock.ts";

const paused = makeClock(1000, 1060);

test("a clock stands until it is played, then goes with wall time", () => {
  assert.equal(timeAt(paused, 50), 1000);
  const playing = play(paused, true, 50);
  assert.equal(timeAt(playing, 53.5), 1003.5);
  assert.equal(timeAt(play(playing, false, 54), 99), 1004);
});

test("a change of speed keeps the moment", () => {
  const fast = setSpeed(play(paused, true, 0), 10, 2);
  assert.equal(timeAt(fast, 2), 1002);
  assert.equal(timeAt(fast, 3), 1012);
});

test("the clock ends at the recording's end, and plays from the beginning again", () => {
  const playing = play(paused, true, 0);
  assert.equal(timeAt(playing, 500), 1060);
  assert.ok(hasEnded(playing, 500));
  assert.equal(timeAt(play(play(playing, false, 500), true, 500), 501), 1001);
});

test("a step pauses, and stays within the recording", () => {
  const stepped = step(play(paused, true, 0), 0.1, 5);
  assert.equal(stepped.playing, false);
  assert.ok(Math.abs(timeAt(stepped, 9) - 1005.1) < 1e-9);
  assert.equal(timeAt(step(paused, -3, 0), 0), 1000);
});

test("a seek goes on playing", () => {
  const sought = seek(play(paused, true, 0), 1030, 10);
  assert.equal(timeAt(sought, 11), 1031);
});

test("what is typed is a time from the start or a time of day", () => {
  const day_s = 86400 * 20000;
  const clock = makeClock(day_s + 3600 * 14, day_s + 3600 * 15);
  assert.equal(parseTime("12.5", clock), clock.begin_s + 12.5);
  assert.equal(parseTime("1:05.5", clock), clock.begin_s + 65.5);
  assert.equal(parseTime("14:03:22", clock), day_s + 14 * 3600 + 202);
  assert.equal(parseTime("soon", clock), null);
  assert.equal(parseTime("1::2", clock), null);
  const midnight = makeClock(day_s + 86000, day_s + 87000);
  assert.equal(parseTime("0:05:00", midnight), day_s + 86400 + 300);
});
