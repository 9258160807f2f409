// SPDX-License-Identifier: Apache-2.0
import assert from "node:assert/strict";
import { test } from "node:test";

import { boxAt, overlayOf } from "../../src/picture/overlay.ts";
import { samplesAt } from "../synthetic.mjs";
import { boxOf, colorInfoAt, pictureAt } from "../synthetic_camera.mjs";
import { peopleAt } from "../synthetic.mjs";
import { fold, sample } from "./make.ts";

const size = { width: 320, height: 240 };

// As the wire has them: one row a power.
const rows = (message: any) => message.pieces ? { ...message, pieces: message.pieces.map(
  (piece: { coefficients: number[] }) => ({ ...piece, coefficients: Array.from({ length: 6 },
    (_, i) => piece.coefficients.slice(3 * i, 3 * i + 3)) })) } : message;

// A second of the made-up flight, and a picture of its end.
function flight(change: (name: string, message: any) => any = (_, message) => message) {
  const inputs = [sample("/uav1/camera/color/camera_info", 0, colorInfoAt(0)[1])];
  for (let step = 400; step <= 500; step++)
    for (const [name, message] of samplesAt(step / 100, step, 0))
      inputs.push(sample(`/uav1/${name}`, step / 100, change(name, rows(message))));
  const [[, info], [, image]] = pictureAt(5, 0) as [[string, any], [string, any]];
  inputs.push(sample("/uav1/camera/ground/camera_info", 5, info));
  const state = fold(inputs);
  const vehicle = state.vehicles.get("uav1")!;
  return { overlay: overlayOf(state, vehicle, image.header, size), state, vehicle, image };
}

test("boxes are those that perception saw, in the picture's own pixels", () => {
  const { overlay } = flight();
  const expected = peopleAt(5).map(({ id, ...at }) => ({ id, box: boxOf(5, 0, at) }))
    .filter(({ box }) => box && box[2]! > 0 && box[0]! < 640);
  assert.ok(expected.length > 0);
  assert.deepEqual(overlay.boxes.map((b) => b.id), expected.map((e) => e.id));
  overlay.boxes.forEach((box, i) => {
    assert.ok(Math.abs(box.left - expected[i]!.box![0]! / 2) < 1e-6);
    assert.ok(Math.abs(box.bottom - expected[i]!.box![3]! / 2) < 1e-6);
    assert.equal(box.seen, true);
    assert.equal(box.followed, box.id === 1);
  });
});

test("who was in no image is drawn where they are thought to be", () => {
  const { overlay } = flight((name, message) => name === "bodies" ? { ...message,
    bodies: message.bodies.map((b: object) => ({ ...b, look_age_s: -1 })) } : message);
  const box = overlay.boxes.find((b) => b.id === 1)!;
  const [left, , right, bottom] = boxOf(5, 0, peopleAt(5)[0]!)!;
  assert.equal(box.seen, false);
  assert.ok(Math.abs((box.left + box.right) / 2 - (left! + right!) / 4) < 1);
  assert.ok(Math.abs(box.bottom - bottom! / 2) < 2);
});

test("what was seen at another time is not drawn over a picture", () => {
  const { state, vehicle, image } = flight();
  const old = { ...image.header, stamp: { sec: 2, nanosec: 0 } };
  assert.deepEqual(overlayOf(state, vehicle, old, size).boxes, []);
});

test("ways and the plan are there, and begin before the vehicle", () => {
  const { overlay } = flight();
  assert.equal(overlay.ways.length, 4);
  assert.ok(overlay.ways.some((way) => way.pieces.flat().length > 8));
  assert.ok(overlay.plan.flat().length > 4);
});

test("who is tapped is the one in front, with room for a finger", () => {
  const box = (id: number, left: number, right: number) => ({ id, left, right, top: 50, bottom: 100,
    followed: false, person: true, seen: true, distance_m: 1 });
  const overlay = { ...size, boxes: [box(1, 10, 110), box(2, 40, 60)], bones: [], ways: [],
    plan: [] };
  assert.equal(boxAt(overlay, 50, 75, 5)?.id, 2);
  assert.equal(boxAt(overlay, 20, 75, 5)?.id, 1);
  assert.equal(boxAt(overlay, 20, 47, 5)?.id, 1);
  assert.equal(boxAt(overlay, 20, 40, 5), null);
});
