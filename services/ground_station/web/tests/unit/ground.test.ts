// SPDX-License-Identifier: Apache-2.0
import assert from "node:assert/strict";
import { test } from "node:test";

import { partsOf } from "../../src/data/topics.ts";
import { cornerOfTile, type GroundMap, piecesOf, tileAt } from "../../src/ground/ground_map.ts";
import { type Metres, placeText, toMetresOf, toWgs84 } from "../../src/ground/place.ts";
import { cornersOnGround } from "../../src/scene/ground.ts";

const origin = { lat_deg: 52.52, lon_deg: 13.41 };
const area = { west: -60, south: -40, east: 60, north: 40 };
const near = (a: Metres, b: Metres, tolerance_m: number): boolean =>
  Math.hypot(a[0] - b[0], a[1] - b[1]) < tolerance_m;

test("places and metres are inverse, and a degree along the meridian is its length on the sphere", () => {
  for (const at of [[0, 0], [1, 0], [-350, 1200], [5000, -7000]] as Metres[])
    assert.ok(near(toMetresOf(origin, toWgs84(origin, at)), at, 1e-6), `${at}`);
  const [east, north] = toMetresOf(origin, { lat_deg: 53.52, lon_deg: 13.41 });
  assert.ok(Math.abs(east) < 1e-6 && Math.abs(north - (6371000 * Math.PI) / 180) < 1e-3);
  const eastward = toWgs84(origin, [100, 0]);
  const degrees = (100 / (6371000 * Math.cos((52.52 * Math.PI) / 180))) * (180 / Math.PI);
  assert.ok(Math.abs(eastward.lon_deg - 13.41 - degrees) < 1e-9);
  assert.equal(placeText({ lat_deg: -33.5, lon_deg: -70.25 }), "33.5000000° S 70.2500000° W");
});

test("tiles are numbered from the north-west, and cover what is seen", () => {
  assert.deepEqual(tileAt({ lat_deg: 0, lon_deg: 0 }, 1), [1, 1]);
  assert.deepEqual(tileAt({ lat_deg: 52.52, lon_deg: 13.41 }, 12).map(Math.floor), [2200, 1343]);
  const map: GroundMap = { kind: "tiles", zoom_min: 10, zoom_max: 18 };
  const pieces = piecesOf(map, origin, area, 2);
  assert.match(pieces[0]!.path, /^map\/18\/\d+\/\d+$/);
  const lefts = pieces.map((p) => p.corners[0][0]);
  const [rights, bottoms] = [pieces.map((p) => p.corners[1][0]), pieces.map((p) => p.corners[2][1])];
  assert.ok(Math.min(...lefts) <= area.west && Math.max(...rights) >= area.east);
  assert.ok(Math.min(...bottoms) <= area.south);
  const corner = cornerOfTile(...tileAt(origin, 18) as [number, number], 18);
  assert.ok(near(toMetresOf(origin, corner), [0, 0], 1e-3));
});

test("far out, tiles become coarser instead of many", () => {
  const map: GroundMap = { kind: "tiles", zoom_min: 10, zoom_max: 18 };
  const wide = { west: -5000, south: -5000, east: 5000, north: 5000 };
  const pieces = piecesOf(map, origin, wide, 8);
  assert.ok(pieces.length > 0 && pieces.length <= 48);
  assert.deepEqual(piecesOf({ ...map, zoom_min: 18 }, origin, wide, 8), []);
});

test("an image in the world needs no global position, one on the Earth does", () => {
  const corners: Metres[] = [[-10, 15], [30, 15], [30, -5], [-10, -5]];
  const yard: GroundMap = { kind: "image", frame: "world", width_px: 40, height_px: 20, corners };
  assert.deepEqual(piecesOf(yard, null, area, 2),
    [{ path: "map/image", corners: [[-10, 15], [30, 15], [-10, -5]] }]);
  const onEarth = corners.map((at): Metres => {
    const { lat_deg, lon_deg } = toWgs84(origin, at);
    return [lon_deg, lat_deg];
  });
  const field: GroundMap = { ...yard, frame: "wgs84", corners: onEarth };
  assert.deepEqual(piecesOf(field, null, area, 2), []);
  const [piece] = piecesOf(field, origin, area, 2);
  for (const [i, corner] of [corners[0]!, corners[1]!, corners[3]!].entries())
    assert.ok(near(piece!.corners[i]!, corner, 1e-5));
});

test("the ground's fourth corner closes the parallelogram", () => {
  const points = cornersOnGround([[0, 10], [20, 12], [1, 0]]);
  assert.deepEqual([points[9], points[10]], [21, 2]);
});

test("a version in the name of the autopilot's topic is no part of what it says", () => {
  assert.equal(partsOf("/fmu/out/vehicle_local_position_v1").name, "fmu/out/vehicle_local_position");
  assert.equal(partsOf("/uav1/fmu/out/battery_status").name, "fmu/out/battery_status");
  assert.equal(partsOf("/uav1/plan_v2").name, "plan_v2");
});
