// SPDX-License-Identifier: Apache-2.0
import assert from "node:assert/strict";
import { test } from "node:test";

import { thin } from "../../src/scene/thin.ts";

type Point = { x: number; y: number; z: number };

const along = (count: number, at: (n: number) => [number, number]): Point[] =>
  Array.from({ length: count }, (_, n) => ({ x: at(n)[0], y: at(n)[1], z: 1 }));

/** The farthest that a point is from a line. */
function farthest_m(points: Point[], line: Point[]): number {
  return Math.max(...points.map((p) => Math.min(...line.slice(1).map((b, i) => {
    const a = line[i]!;
    const [dx, dy] = [b.x - a.x, b.y - a.y];
    const share = Math.min(1, Math.max(0,
      ((p.x - a.x) * dx + (p.y - a.y) * dy) / (dx * dx + dy * dy)));
    return Math.hypot(p.x - a.x - share * dx, p.y - a.y - share * dy);
  }))));
}

test("a straight line keeps its ends and a point every metre and a half", () => {
  const points = along(101, (n) => [0.1 * n, 0]);
  const kept = thin(points);
  assert.ok(kept.length <= 8 && kept.length >= 7, `${kept.length}`);
  assert.deepEqual([kept[0], kept.at(-1)], [points[0], points.at(-1)]);
});

test("a circle stays within two centimetres, with a sixth of its points", () => {
  const points = along(250, (n) => [4 * Math.cos(0.025 * n), 4 * Math.sin(0.025 * n)]);
  const kept = thin(points);
  assert.ok(kept.length < 45, `${kept.length}`);
  assert.ok(farthest_m(points, kept) < 0.0201);
});

test("a corner and a way back are kept", () => {
  const points = along(31, (n) => [n < 11 ? 0.1 * n : n < 21 ? 1 : 1 - 0.1 * (n - 20),
    n < 11 ? 0 : n < 21 ? 0.1 * (n - 10) : 1]);
  assert.ok(farthest_m(points, thin(points)) < 1e-9);
  assert.deepEqual(thin(along(21, (n) => [0.1 * (10 - Math.abs(n - 10)), 0])).map((p) => p.x),
    [0, 1, 0]);
});

test("what has no or one point stays", () => {
  assert.deepEqual(thin([]), []);
  assert.equal(thin(along(1, () => [0, 0])).length, 1);
});
