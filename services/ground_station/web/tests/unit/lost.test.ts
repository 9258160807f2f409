// SPDX-License-Identifier: Apache-2.0
import assert from "node:assert/strict";
import { test } from "node:test";
import { Vector3 } from "three";

import { Lost, maxCells, squaresOf } from "../../src/scene/lost.ts";
import type { Search } from "../../src/scene/sketch.ts";

const search = (more: Partial<Search> = {}): Search => ({ mode: 1, x: -2, y: 3, z: 1.2, cell_m: 1,
  columns: 2, belief: new Uint8Array([0, 255, 64, 0]), likeliest: [-0.5, 3.5, 1.2],
  viewpoint: [4, 5, 1.3], ...more });

test("belief is drawn where it is, as large as it is likely", () => {
  const squares = squaresOf(search());
  assert.equal(squares.length, 2);
  const [at, size] = [new Vector3(), new Vector3()];
  at.setFromMatrixPosition(squares[0]!);
  size.setFromMatrixScale(squares[0]!);
  assert.deepEqual([at.x, at.y, size.x], [-0.5, 3.5, 1]);
  at.setFromMatrixPosition(squares[1]!);
  size.setFromMatrixScale(squares[1]!);
  assert.deepEqual([at.x, at.y], [-1.5, 4.5]);
  assert.ok(Math.abs(size.x - 0.5) < 0.01);
});

test("no more squares than there is room for", () => {
  assert.equal(squaresOf(search({ belief: new Uint8Array(3000).fill(9) })).length, maxCells);
});

test("nothing is drawn of who is not lost", () => {
  const lost = new Lost();
  assert.equal(lost.group.visible, false);
  lost.set(search());
  assert.equal(lost.group.visible, true);
  lost.set(search({ mode: 0 }));
  assert.equal(lost.group.visible, false);
  lost.set(search({ viewpoint: null }));
  assert.equal(lost.group.visible, true);
});
