// SPDX-License-Identifier: Apache-2.0
import assert from "node:assert/strict";
import { test } from "node:test";

import { Vector3 } from "three";

import type { MovingBodies } from "../../src/data/messages.ts";
import { maxBodies, placeOf, pointsOf } from "../../src/scene/around.ts";
import { sketch } from "../../src/scene/sketch.ts";
import { stamp } from "./make.ts";

const body = { id: 3, kind: 0, followed: false, position_m: [1, 2, 0.1], velocity_mps: [2, 0, 0],
  radius_m: 0.25, height_m: 1.8, place_step_s: 0.2, places_m: [] };
const sketched = (bodies: MovingBodies["bodies"]) =>
  sketch("bodies", { time_s: 1, message: { header: { stamp: stamp(1), frame_id: "map" }, bodies } },
    true).message;

test("a body is a cylinder on its feet, of its radius and height", () => {
  const matrix = placeOf(sketched([body])[0]!);
  const at = (x: number, y: number, z: number) => new Vector3(x, y, z).applyMatrix4(matrix);
  assert.deepEqual(at(0, 0, -0.5).toArray().map((v) => +v.toFixed(9)), [1, 2, 0.1]);
  assert.ok(Math.abs(at(0, 0, 0.5).z - 1.9) < 1e-9);
  assert.ok(Math.abs(at(1, 0, 0).x - 1.25) < 1e-9);
});

test("without places it is expected where its velocity leads, else at its places", () => {
  const straight = pointsOf(sketched([body])[0]!);
  assert.equal(straight.length, 2);
  assert.ok(Math.abs(straight[1]![0] - 4) < 1e-6 && straight[1]![1] === 2);
  const places_m = [{ x: 1, y: 3, z: 0 }, { x: 1, y: 4, z: 0 }];
  const path = pointsOf(sketched([{ ...body, followed: true, places_m }])[0]!);
  assert.deepEqual(path.map(([x, y]) => [x, y]), [[1, 2], [1, 3], [1, 4]]);
});

test("as many are told as the vehicle knows", () => {
  const all = sketched(Array.from({ length: maxBodies }, (_, id) => ({ ...body, id })));
  assert.equal(all.length, maxBodies);
});
