// SPDX-License-Identifier: Apache-2.0
import assert from "node:assert/strict";
import { test } from "node:test";

import { codecOf } from "../../src/picture/video.ts";
import { isKey, VideoRun } from "../../src/store/video_run.ts";
import { keyPicture, repeatedPicture } from "../synthetic_video.mjs";

const size = { width: 32, height: 16 };
const key = keyPicture(size, () => [90, 90, 90]);
const other = repeatedPicture(size, 1);
const message = (data: Uint8Array, sec = 0) => ({ timestamp: { sec, nanosec: 0 }, frame_id: "camera",
  data, format: "h264" });

test("a key picture is known by its slice, and its codec by its parameter set", () => {
  assert.equal(isKey(key), true);
  assert.equal(isKey(other), false);
  assert.equal(isKey(new Uint8Array()), false);
  assert.equal(codecOf(key), "avc1.42c01f");
  assert.equal(codecOf(other), null);
});

test("a run begins at the last key picture, and its numbers grow over all keys", () => {
  const run = new VideoRun();
  assert.deepEqual([run.first, run.last], [-1, -1]);
  run.push(message(other)); // needs one that was never heard
  assert.deepEqual([run.first, run.last], [-1, -1]);
  for (const [i, data] of [key, other, other, key, other].entries()) run.push(message(data, i));
  assert.deepEqual([run.first, run.last], [4, 5]);
  assert.deepEqual([run.at(4).timestamp.sec, run.at(5).timestamp.sec], [3, 4]);
});

test("a run without keys does not grow for ever", () => {
  const run = new VideoRun();
  run.push(message(key));
  for (let i = 0; i < 1000; i++) run.push(message(other));
  assert.equal(run.first, -1);
  run.push(message(key));
  assert.equal(run.last, run.first);
});
