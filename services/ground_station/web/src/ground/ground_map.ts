// SPDX-License-Identifier: Apache-2.0
// The images that lie under a view of the ground, and where.
import { type Metres, toMetresOf, toWgs84, type Wgs84 } from "./place.ts";

/** GET /map.json. Corners: upper left, upper right, lower right, lower left; x or longitude first. */
export type GroundMap =
  | { kind: "image"; frame: "world" | "wgs84"; width_px: number; height_px: number;
      corners: [number, number][] }
  | { kind: "tiles"; zoom_min: number; zoom_max: number };

/** An image and three of its corners in the world: upper left, upper right, lower left. */
export interface Piece { path: string; corners: [Metres, Metres, Metres] }
export interface Area { west: number; south: number; east: number; north: number }

const mostTiles = 48;
const tile_px = 256;

/** Of XYZ: how far a place is from the map's corner in the north-west, in tiles. */
export function tileAt({ lat_deg, lon_deg }: Wgs84, zoom: number): [number, number] {
  const lat = (lat_deg * Math.PI) / 180;
  const n = 2 ** zoom;
  return [((lon_deg + 180) / 360) * n,
    ((1 - Math.asinh(Math.tan(lat)) / Math.PI) / 2) * n];
}

export function cornerOfTile(x: number, y: number, zoom: number): Wgs84 {
  const n = 2 ** zoom;
  return { lon_deg: (x / n) * 360 - 180,
    lat_deg: (Math.atan(Math.sinh(Math.PI * (1 - (2 * y) / n))) * 180) / Math.PI };
}

function tilesOf(map: GroundMap & { kind: "tiles" }, origin: Wgs84, area: Area, zoom: number): Piece[] {
  const [left, top] = tileAt(toWgs84(origin, [area.west, area.north]), zoom).map(Math.floor);
  const [right, bottom] = tileAt(toWgs84(origin, [area.east, area.south]), zoom).map(Math.floor);
  const [columns, rows] = [right! - left! + 1, bottom! - top! + 1];
  if (columns * rows > mostTiles)
    return zoom > map.zoom_min ? tilesOf(map, origin, area, zoom - 1) : [];
  return Array.from({ length: columns * rows }, (_, i): Piece => {
    const [x, y] = [left! + (i % columns), top! + Math.floor(i / columns)];
    const at = (u: number, v: number): Metres => toMetresOf(origin, cornerOfTile(u, v, zoom));
    return { path: `map/${zoom}/${x}/${y}`, corners: [at(x, y), at(x + 1, y), at(x, y + 1)] };
  });
}

/** The zoom whose pixels are as fine as those that are drawn. */
function zoomFor(map: GroundMap & { kind: "tiles" }, origin: Wgs84, px_per_m: number): number {
  const around_m = 2 * Math.PI * 6378137 * Math.cos((origin.lat_deg * Math.PI) / 180);
  const zoom = Math.round(Math.log2((around_m * px_per_m) / tile_px));
  return Math.min(map.zoom_max, Math.max(map.zoom_min, zoom));
}

/** Empty where a map on the Earth is not to be placed, as the vehicle knows no global position. */
export function piecesOf(map: GroundMap, origin: Wgs84 | null, area: Area, px_per_m: number): Piece[] {
  if (map.kind === "tiles")
    return origin ? tilesOf(map, origin, area, zoomFor(map, origin, px_per_m)) : [];
  if (map.frame === "wgs84" && !origin) return [];
  const at = ([x, y]: [number, number]): Metres => map.frame === "world" ? [x, y]
    : toMetresOf(origin!, { lon_deg: x, lat_deg: y });
  const [upperLeft, upperRight, , lowerLeft] = map.corners.map(at);
  return [{ path: "map/image", corners: [upperLeft!, upperRight!, lowerLeft!] }];
}
