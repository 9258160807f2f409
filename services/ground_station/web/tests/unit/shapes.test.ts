// SPDX-License-Identifier: Apache-2.0
import assert from "node:assert/strict";
import { test } from "node:test";

import { Vector3 } from "three";

import type { CorridorFace, LocalMap, PointCloud2 } from "../../src/data/messages.ts";
import { stacked } from "../../src/plots/frames.ts";
import { fenceEdges, homeEdges } from "../../src/scene/bounds.ts";
import { polytopeEdges } from "../../src/scene/corridor.ts";
import { blocks, voxelsOfMap, voxelsOfPoints } from "../../src/scene/voxels.ts";
import { wallGeometry } from "../../src/scene/walls.ts";
import { Series, Trail } from "../../src/store/series.ts";

const cube: CorridorFace[] = [[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]]
  .map((normal) => ({ normal, offset_m: 1 }));

test("a cube has twelve edges of its side's length, also with a face that only touches it", () => {
  for (const faces of [cube, [...cube, { normal: [1, 0, 0], offset_m: 5 }]]) {
    const edges = polytopeEdges(faces);
    assert.equal(edges.length, 12);
    for (const [a, b] of edges)
      assert.ok(Math.abs(Math.hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]) - 2) < 1e-9);
  }
});

test("an empty polytope has no edges", () => {
  assert.equal(polytopeEdges([...cube, { normal: [1, 0, 0], offset_m: -2 }]).length, 0);
});

function mapOf(occupied: [number, number, number][]): LocalMap {
  const cells = new Uint8Array(4 * 4 * 8);
  cells[5] = 2; // unknown is not occupied
  for (const [i, j, k] of occupied) cells[i + 4 * (j + 4 * k)] = 1;
  return { header: { stamp: { sec: 0 }, frame_id: "map" }, resolution_m: 0.5, origin_m: [-1, 0, 0],
    size_x: 4, size_y: 4, size_z: 8, cells };
}

test("cells above each other are one box, a gap makes two", () => {
  const found = blocks(voxelsOfMap(mapOf([[0, 0, 0], [0, 0, 1], [0, 0, 4], [2, 3, 7]])));
  assert.deepEqual(found, [
    { x0: -1, x1: -0.5, y0: 0, y1: 0.5, z0: 0, z1: 1 },
    { x0: -1, x1: -0.5, y0: 0, y1: 0.5, z0: 2, z1: 2.5 },
    { x0: 0, x1: 0.5, y0: 1.5, y1: 2, z0: 3.5, z1: 4 }]);
});

test("boxes cover exactly the occupied cells, each once", () => {
  const random = (n: number): number => (Math.sin(n * 12.9898) * 43758.5453) % 1;
  const cells: [number, number, number][] = [];
  for (let n = 0; n < 128; n++)
    if (Math.abs(random(n)) < 0.6) cells.push([n % 4, (n >> 2) % 4, n >> 4]);
  const covered = blocks(voxelsOfMap(mapOf(cells))).flatMap((b) => {
    const inside: string[] = [];
    for (let x = b.x0; x < b.x1; x += 0.5)
      for (let y = b.y0; y < b.y1; y += 0.5)
        for (let z = b.z0; z < b.z1; z += 0.5) inside.push(`${2 * x + 2} ${2 * y} ${2 * z}`);
    return inside;
  });
  assert.deepEqual(covered.sort(), cells.map((c) => c.join(" ")).sort());
});

test("a wall is one box, cut at the ceiling, without the ground", () => {
  const wall = Array.from({ length: 24 }, (_, n): [number, number, number] => [n % 4, 1, n >> 2]);
  const ground: [number, number, number][] = [[0, 3, 0], [1, 3, 0]];
  assert.deepEqual(blocks(voxelsOfMap(mapOf([...wall, ...ground])), 0.6, 1.2),
    [{ x0: -1, x1: 1, y0: 0.5, y1: 1, z0: 0, z1: 1.2 }]);
});

test("the walls' triangles enclose their boxes, and look outward", () => {
  const geometry = wallGeometry([{ x0: 0, x1: 2, y0: 0, y1: 1, z0: 0, z1: 3 },
    { x0: 5, x1: 6, y0: 5, y1: 7, z0: 1, z1: 2 }]);
  const index = geometry.getIndex()!;
  const corners = geometry.getAttribute("position");
  let volume = 0; // by the divergence theorem
  for (let i = 0; i < index.count; i += 3) {
    const [a, b, c] = [0, 1, 2].map((n) =>
      new Vector3().fromBufferAttribute(corners, index.getX(i + n)));
    volume += a!.dot(b!.cross(c!)) / 6;
  }
  assert.ok(Math.abs(volume - (6 + 2)) < 1e-5, `${volume}`);
});

test("the cloud of a map's cells gives the map's voxels", () => {
  const map = voxelsOfMap(mapOf([[0, 0, 0], [1, 0, 0], [3, 0, 0], [2, 2, 5]]));
  const cloud: PointCloud2 = { header: { stamp: { sec: 0 }, frame_id: "map" }, height: 1,
    width: map.centers.length / 3, point_step: 12, data: new Uint8Array(map.centers.buffer),
    fields: ["x", "y", "z"].map((name, i) => ({ name, offset: 4 * i, datatype: 7 })) };
  assert.deepEqual(voxelsOfPoints(cloud), map);
});

test("a stack's top is the sum, and a missing row stays missing", () => {
  assert.deepEqual(stacked([[0.2, null, 0.5], [0.3, null, null]]),
    [[0.2, null, 0.5], [0.5, null, 0.5]]);
});

test("a series is thinned, shows gaps, and forgets what is old", () => {
  const series = new Series(["a"], 0.04, 10);
  for (let i = 0; i < 4000; i++) series.push(i / 100, [i]);
  assert.ok(series.times.length < 400 && series.times[0]! > 20);
  series.push(42, [1]);
  const [before, last] = series.columns[0]!.slice(-2);
  assert.deepEqual([before, last], [null, 1]);
});

test("names that come up later get columns of their own", () => {
  const series = new Series([]);
  series.pushNamed(0, new Map([["a", 1]]));
  series.pushNamed(0.5, new Map([["b", 2]]));
  assert.deepEqual([series.names, series.columns], [["a", "b"], [[1, null], [null, 2]]]);
});

test("a trail forgets where it was when its owner is put elsewhere", () => {
  const trail = new Trail();
  trail.push(0, 0, 0, 0);
  trail.push(0.1, 0.01, 0, 0);
  trail.push(0.2, 1, 0, 0);
  assert.equal(trail.points.length, 2);
  trail.push(0.3, 100, 0, 0);
  assert.equal(trail.points.length, 1);
  trail.push(0.4, NaN, 0, 0);
  assert.equal(trail.points.length, 1);
});

test("a fence is a cage between its altitudes, and the return place lies at its middle", () => {
  const square = { fence: Float64Array.of(0, 0, 10, 0, 10, 10, 0, 10), low_m: 2, high_m: 6,
    home: [3, 4, 0] };
  const edges = fenceEdges(square);
  assert.equal(edges.length, 3 * 4 + 4);
  assert.deepEqual([...new Set(edges.flat().map(([, , z]) => z))].sort(), [0.04, 2, 6]);
  assert.deepEqual(edges.at(-1), [[0, 10, 2], [0, 10, 6]]);
  assert.equal(fenceEdges({ ...square, high_m: null }).length, 4 + 4);
  assert.deepEqual(fenceEdges({ ...square, fence: new Float64Array() }), []);
  const ends = homeEdges(square).flat();
  for (const axis of [0, 1] as const) {
    const values = ends.map((point) => point[axis]);
    assert.ok(Math.abs((Math.min(...values) + Math.max(...values)) / 2 - [3, 4][axis]!) < 1e-9);
  }
  assert.deepEqual(homeEdges({ ...square, home: null }), []);
});
